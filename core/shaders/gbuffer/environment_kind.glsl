// The kind of environment that a pass is compiled for. Passes that know the kind replace this file (bind_environment()
// of core/gbuffer/environment_images.h).
const uint any_environment = 4u;
const uint environment_kind = any_environment;
