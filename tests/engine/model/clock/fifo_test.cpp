// Two-phase rules: pushes and the space freed by pops are visible one cycle later; in crossing FIFOs two edges later.

#include "engine/model/clock/fifo.hpp"
#include "engine/model/clock/crossing_fifo.hpp"
#include "engine/model/signals/messages.hpp"

#include <gtest/gtest.h>

namespace rs::engine::model {
namespace {

Done item(int n) {
    return {n};
}

TEST(Fifo, APushIsVisibleInTheNextCycle) {
    Fifo<Done> fifo("f", 3, 1);
    fifo.push(item(7));
    EXPECT_FALSE(fifo.can_pop());
    EXPECT_TRUE(fifo.commit());
    ASSERT_TRUE(fifo.can_pop());
    EXPECT_EQ(fifo.front().number, 7);
}

TEST(Fifo, SpaceOfAPopIsVisibleInTheNextCycle) {
    Fifo<Done> fifo("f", 1, 1);
    fifo.push(item(1));
    fifo.commit();
    EXPECT_FALSE(fifo.can_push());
    EXPECT_EQ(fifo.pop().number, 1);
    EXPECT_FALSE(fifo.can_push());  // depth 1: an item every second cycle
    fifo.commit();
    EXPECT_TRUE(fifo.can_push());
    EXPECT_FALSE(fifo.commit());  // nothing moved
}

TEST(Fifo, PushAndPopOfOneCycleDoNotMeetInEitherOrder) {
    for (const bool pop_first : {false, true}) {
        for (const int depth : {2, 3, 4, 5}) {
            Fifo<Done> fifo("f", depth, 1);
            fifo.push(item(0));
            fifo.commit();
            for (int n = 1; n < 20; ++n) {  // one item per cycle, around the ring
                if (pop_first) {
                    EXPECT_EQ(fifo.pop().number, n - 1);
                }
                fifo.push(item(n));
                if (!pop_first) {
                    EXPECT_EQ(fifo.pop().number, n - 1);
                }
                fifo.commit();
                EXPECT_EQ(fifo.count(), 1);
            }
        }
    }
}

TEST(Fifo, HoldsItsDepthAndNoMore) {
    for (const int depth : {1, 2, 3, 7, 8}) {
        Fifo<Done> fifo("f", depth, 1);
        for (int n = 0; n < depth; ++n) {
            ASSERT_TRUE(fifo.can_push());
            fifo.push(item(n));
            fifo.commit();
        }
        EXPECT_FALSE(fifo.can_push());
        for (int n = 0; n < depth; ++n) {
            EXPECT_EQ(fifo.item_text(0), std::to_string(n));
            EXPECT_EQ(fifo.pop().number, n);
            fifo.commit();
        }
    }
}

TEST(FifoDeathTest, BrokenRulesStopTheProgram) {
    Fifo<Done> fifo("f", 2, 1);
    EXPECT_DEATH(fifo.pop(), "check failed");
    fifo.push(item(1));
    EXPECT_DEATH(fifo.push(item(2)), "check failed");  // one write port
    EXPECT_DEATH(fifo.pop(), "check failed");          // not visible yet
}

TEST(CrossingFifo, APushIsVisibleAtTheReadersSecondEdge) {
    CrossingFifo<Done> fifo("f", 4, 1);
    fifo.push(item(5));
    fifo.commit_writer();
    EXPECT_FALSE(fifo.can_pop());
    fifo.commit_reader();
    EXPECT_FALSE(fifo.can_pop());
    fifo.commit_reader();
    ASSERT_TRUE(fifo.can_pop());
    EXPECT_EQ(fifo.pop().number, 5);
}

TEST(CrossingFifo, SpaceOfAPopIsVisibleAtTheWritersSecondEdge) {
    CrossingFifo<Done> fifo("f", 1, 1);
    fifo.push(item(5));
    fifo.commit_writer();
    fifo.commit_reader();
    fifo.commit_reader();
    fifo.pop();
    fifo.commit_reader();
    EXPECT_FALSE(fifo.can_push());
    fifo.commit_writer();
    EXPECT_FALSE(fifo.can_push());
    fifo.commit_writer();
    EXPECT_TRUE(fifo.can_push());
}

}  // namespace
}  // namespace rs::engine::model
