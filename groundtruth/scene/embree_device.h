#pragma once
#include <embree3/rtcore.h>
#include <string>

/// Opens Embree, whose device the caller releases. Fails with MachineError if it cannot run here.
RTCDevice open_embree();

/// What Embree could not do ("build a scene"), and why.
std::string embree_sentence(RTCError error, const std::string& what);
