// What others took of the machine, from made-up counters.
#include "core/cpu_times.h"

#include <gtest/gtest.h>

TEST(CpuTimes, ReadsProcStat) {
    // user nice system idle iowait irq softirq steal guest guest_nice; guests are in user already
    const auto times = parse_proc_stat("cpu  100 20 30 4000 500 6 7 8 90 10\ncpu0 1 2 3\ncpu1 4 5 6\nintr 7\n", 100);
    ASSERT_TRUE(times);
    EXPECT_DOUBLE_EQ(times->busy, 1.71);
    EXPECT_DOUBLE_EQ(times->stolen, 0.08);
    EXPECT_EQ(times->cpus, 2u);
    EXPECT_FALSE(parse_proc_stat("", 100));
    EXPECT_FALSE(parse_proc_stat("cpu  0 0 0 0 0 0 0 0 0 0\ncpu0 0 0 0 0 0 0 0 0 0 0\n", 100)) << "some containers";
    EXPECT_FALSE(parse_proc_stat("no such file", 100));
}

TEST(CpuTimes, ForeignLoadIsWhatOthersTookOfAllCpus) {
    const CpuTimes before{.machine = 100, .own = 10, .wall = 5, .cpus = 4};
    const auto after = [](double machine, double own) {
        return CpuTimes{.machine = machine, .own = own, .wall = 7, .cpus = 4};
    };
    EXPECT_DOUBLE_EQ(*foreign_load(before, after(106, 16)), 0.0) << "all of it was ours";
    EXPECT_DOUBLE_EQ(*foreign_load(before, after(106, 12)), 0.5) << "4 of 8 s of CPU time";
    EXPECT_DOUBLE_EQ(*foreign_load(before, after(105.9, 16)), 0.0) << "sampling errs";
    EXPECT_FALSE(foreign_load(before, {.machine = {}, .own = 16, .wall = 7, .cpus = 4}));
    EXPECT_FALSE(foreign_load(before, before));
    EXPECT_DOUBLE_EQ(stolen_share(before, {.stolen = 2, .wall = 7, .cpus = 4}), 0.25) << "2 of 8 s of CPU time";
    EXPECT_EQ(stolen_share(before, before), 0.0);
}

TEST(CpuTimes, OfThisMachineGrow) {
    const CpuTimes before = read_cpu_times();
    volatile double sum = 0;
    for (int i = 0; i < 1'000'000; ++i) sum = sum + i;
    const CpuTimes after = read_cpu_times();
    EXPECT_GT(after.own, before.own);
    EXPECT_GT(after.wall, before.wall);
    EXPECT_GE(after.cpus, 1u);
    EXPECT_GE(after.machine.value_or(0), before.machine.value_or(0));
}
