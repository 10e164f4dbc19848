// Which kind of environment a pass is compiled for; passes that know it put their own in this file's place
// (bind_environment() of core/gbuffer/environment_images.h).
const uint any_environment = 4u;
const uint environment_kind = any_environment;
