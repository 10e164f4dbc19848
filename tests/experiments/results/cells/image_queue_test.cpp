#include "experiments/study/shots/image_queue.h"
#include "core/error.h"

#include <gtest/gtest.h>

TEST(ImageQueue, KeepsTheOrderAndTellsWhatFailed) {
    ImageQueue queue;
    for (int i = 0; i < 3; ++i) queue.add([i] { return ImageQueue::Entries{{{"first of", i}}, {{"second of", i}}}; });
    const ImageQueue::Entries entries = queue.finish();
    ASSERT_EQ(entries.size(), 6u);
    EXPECT_EQ(entries[2]["first of"], 1);
    EXPECT_EQ(entries[5]["second of"], 2);

    const auto full_disk = []() -> ImageQueue::Entries { fail_machine("the disk is full"); };
    ImageQueue last, before;
    last.add(full_disk);
    EXPECT_THROW(last.finish(), MachineError);
    before.add(full_disk);
    EXPECT_THROW(before.add([] { return ImageQueue::Entries{}; }), MachineError);
}
