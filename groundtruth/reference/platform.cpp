#include "groundtruth/reference/platform.h"

#include "groundtruth/scene/embree_device.h"

#include <gnu/libc-version.h>

namespace {

/// Of the library that runs, which need not be the one whose headers were compiled: "31305".
std::string embree_version() {
    const RTCDevice device = open_embree();
    const auto version = rtcGetDeviceProperty(device, RTC_DEVICE_PROPERTY_VERSION);
    rtcReleaseDevice(device);
    return std::to_string(version);
}

const char* instruction_set() {
    if (__builtin_cpu_supports("x86-64-v4")) return "x86-64-v4";
    if (__builtin_cpu_supports("x86-64-v3")) return "x86-64-v3";
    return __builtin_cpu_supports("x86-64-v2") ? "x86-64-v2" : "x86-64";
}

}  // namespace

std::string render_platform() {
    static const std::string platform =
        "embree " + embree_version() + ", " + instruction_set() + ", glibc " + gnu_get_libc_version();
    return platform;
}
