// The original's variance without history: large enough to start the cleanup.
const float unknown_variance = 1.0;
