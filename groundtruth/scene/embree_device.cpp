#include "groundtruth/scene/embree_device.h"

#include "core/error.h"
#include "core/memory_fault.h"

RTCDevice open_embree() {
    const RTCDevice device = rtcNewDevice(nullptr);
    if (!device) fail_machine(embree_sentence(rtcGetDeviceError(nullptr), "start"));
    return device;
}

std::string embree_sentence(RTCError error, const std::string& what) {
    if (error == RTC_ERROR_OUT_OF_MEMORY) return memory_sentence(" for Embree, the ray tracer, to " + what);
    if (error == RTC_ERROR_UNSUPPORTED_CPU)
        return "Embree, the ray tracer, cannot run on this processor, which lacks SSE2";
    return "Embree, the ray tracer, cannot " + what + " (error " + std::to_string(error) + ")";
}
