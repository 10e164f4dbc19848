#pragma once
#include "experiments/cli/command_line.h"

// The commands of `ssrlab`. Each, in a file of its name, adds its options and its action to the command line. They
// throw Error for mistakes and MachineError for faults.

void add_run(Commands& line);
void add_plan(Commands& line);
void add_merge(Commands& line);
void add_report(Commands& line);
void add_figures(Commands& line);
void add_diff(Commands& line);
void add_judge(Commands& line);
void add_scene_for(Commands& line);
void add_tables(Commands& line);
void add_tradeoff(Commands& line);
void add_advise(Commands& line);
void add_tune(Commands& line);
void add_compare(Commands& line);
void add_reference(Commands& line);
void add_gbuffer(Commands& line);
void add_capture(Commands& line);
void add_inspect(Commands& line);
void add_needs(Commands& line);
void add_shaders(Commands& line);
void add_export_shaders(Commands& line);
void add_rays(Commands& line);
void add_record(Commands& line);
void add_watch(Commands& line);
void add_stability(Commands& line);
void add_new(Commands& line);
void add_describe(Commands& line);
void add_list(Commands& line);
