#pragma once
#include "experiments/study/ended_point.h"

#include <functional>
#include <vector>

/// Runs `work` in a child process and returns its exit code. Drivers run shaders in the process that asks for them: a
/// shader that ends that process ends the child alone, and an error names the signal, the technique and the pass
/// (exit code 3). With `leaves_out_points`, if a point of a study was at work, `work` is then run once more, and gets
/// all points that ended it so far.
///
/// Signals by which another process asks this one to end reach the child; those of a terminal do by themselves. The
/// child is killed if this process is. Call it before the process has threads.
int supervised(const std::function<int(const std::vector<EndedPoint>& ended)>& work, bool leaves_out_points);
