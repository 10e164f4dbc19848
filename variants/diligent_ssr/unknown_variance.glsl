// The original's where history is missing: large enough for the cleanup.
const float unknown_variance = 1.0;
