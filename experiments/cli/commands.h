#pragma once
#include "experiments/cli/command_line.h"

// The commands of `ssrlab`: each, in a file of its name, adds its options and what it does to the command line. They
// throw Error for mistakes and MachineError for faults.

void add_run(CommandLine& line);
void add_plan(CommandLine& line);
void add_merge(CommandLine& line);
void add_report(CommandLine& line);
void add_figures(CommandLine& line);
void add_diff(CommandLine& line);
void add_judge(CommandLine& line);
void add_scene_for(CommandLine& line);
void add_tables(CommandLine& line);
void add_tradeoff(CommandLine& line);
void add_statistics(CommandLine& line);
void add_tune(CommandLine& line);
void add_compare(CommandLine& line);
void add_reference(CommandLine& line);
void add_gbuffer(CommandLine& line);
void add_capture(CommandLine& line);
void add_inspect(CommandLine& line);
void add_needs(CommandLine& line);
void add_shaders(CommandLine& line);
void add_rays(CommandLine& line);
void add_record(CommandLine& line);
void add_watch(CommandLine& line);
void add_stability(CommandLine& line);
void add_new(CommandLine& line);
void add_describe(CommandLine& line);
void add_list(CommandLine& line);
