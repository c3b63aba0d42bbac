// Items that are done by a tool, for which a script stands in: what is done, what is kept, what an earlier run has
// left.

#include "compositor/farm/work/tool_job.hpp"
#include "rayspace/file/file_output.hpp"
#include "rayspace/file/input_list.hpp"
#include "tests/support/file_text.hpp"
#include "tests/support/temporary_folder.hpp"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <fstream>
#include <iterator>
#include <thread>

namespace rs::farm {
namespace {

using rs::test::text_in;

namespace fs = std::filesystem;

class FarmToolJob : public testing::Test {
protected:
    void SetUp() override {
        fs::create_directories(folder_ / "set");
        std::ofstream(folder_ / "set" / "photo") << "pixels";
        std::ofstream(folder_ / "other") << "other pixels";
        be_tool("cat \"$1/photo\" > \"$output\"");
        order_ = {.tool = "tool",
                  .arguments = {(folder_ / "set").string(), "--quality", "3"},
                  .folder = (folder_ / "set").string(),
                  .output = (folder_ / "result").string(),
                  .state = (folder_ / "state").string()};
    }

    // `work` finds the last argument in $output, and the input's list is written after it.
    void be_tool(const std::string& work) const {
        std::ofstream(folder_ / "inputs.txt") << list_of_inputs();
        std::ofstream(folder_ / "tool") << "#!/bin/sh\necho run >> " << (folder_ / "runs").string()
                                        << "\nfor output; do :; done\n"
                                        << work << "\n[ $? = 0 ] || exit 1\ncp " << (folder_ / "inputs.txt").string()
                                        << " \"$RAYSPACE_INPUTS\"\n";
        ::chmod((folder_ / "tool").c_str(), 0755);
    }
    std::string list_of_inputs() const {
        std::vector<InputStamp> stamps;
        for (const fs::path& path : {folder_ / "set" / "photo", folder_ / "other"}) {
            stamps.push_back({path, *sum_of_file(path), fs::file_size(path), 0});
        }
        return input_list_text(stamps);
    }
    Outcome run(const Outcome* record = nullptr) const {
        const auto job = begin_tool_jobs({.tools = folder_.path(), .processors = {}})(to_json(order_), record);
        for (;;) {
            if (const auto outcome = job->poll()) return *outcome;
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
        }
    }
    // As the coordinator does.
    static Outcome put_in_place(const Outcome& outcome) {
        EXPECT_TRUE(move_into_place(outcome.staged, outcome.output).ok());
        return outcome;
    }
    [[nodiscard]] int runs() const {
        const std::string text = text_in(folder_ / "runs");
        return static_cast<int>(std::count(text.begin(), text.end(), '\n'));
    }

    rs::test::TemporaryFolder folder_;
    ToolOrder order_;
};

TEST_F(FarmToolJob, MakesAResultAndKeepsIt) {
    const Outcome made = run();
    ASSERT_EQ(made.state, State::kMade) << made.why;
    EXPECT_FALSE(made.recorded);
    EXPECT_FALSE(fs::exists(folder_ / "result")) << "it is not in the manifest yet";
    EXPECT_EQ(text_in(made.staged), "pixels");
    EXPECT_GT(made.memory_bytes, 0);
    put_in_place(made);
    EXPECT_EQ(run(&made).state, State::kKept);
    EXPECT_EQ(runs(), 1);
}

TEST_F(FarmToolJob, AStagedResultIsNotMadeAgain) {
    const Outcome made = run();
    const Outcome found = run();  // killed before the manifest said so
    EXPECT_EQ(found.state, State::kMade);
    EXPECT_FALSE(found.recorded);
    EXPECT_EQ(found.sum, made.sum);
    const Outcome renamed = run(&made);  // killed before the rename
    EXPECT_EQ(renamed.state, State::kMade);
    EXPECT_TRUE(renamed.recorded);
    EXPECT_EQ(renamed.staged, made.staged);
    EXPECT_EQ(runs(), 1);
}

TEST_F(FarmToolJob, OtherInputsOptionsOrNamesAreDoneAnew) {
    Outcome last = put_in_place(run());
    const auto is_done_anew = [&](const char* what) {
        const Outcome again = run(&last);
        EXPECT_EQ(again.state, State::kMade) << what << again.why;
        if (again.state == State::kMade) last = put_in_place(again);
        EXPECT_EQ(run(&last).state, State::kKept) << what;
    };
    std::ofstream(folder_ / "set" / "photo") << "brighter pixels";
    be_tool("cat \"$1/photo\" > \"$output\"");
    is_done_anew("a file of the folder");
    EXPECT_EQ(text_in(folder_ / "result"), "brighter pixels");
    std::ofstream(folder_ / "other") << "others";
    be_tool("cat \"$1/photo\" > \"$output\"");
    is_done_anew("a file that was read from elsewhere");
    order_.arguments.back() = "4";
    is_done_anew("an option");
    std::ofstream(folder_ / "set" / "photo2") << "a further photograph";
    is_done_anew("a new file in the folder");
    std::ofstream(folder_ / "result") << "by hand";
    is_done_anew("a result that was changed");
    fs::remove(folder_ / "result");
    is_done_anew("a result that is gone");
    EXPECT_EQ(runs(), 7);
}

TEST_F(FarmToolJob, AFileThatWasOnlyTouchedIsTheSame) {
    const Outcome made = put_in_place(run());
    fs::last_write_time(folder_ / "set" / "photo", fs::file_time_type::clock::now() + std::chrono::hours(1));
    EXPECT_EQ(run(&made).state, State::kKept);
}

TEST_F(FarmToolJob, SaysWhyItFailed) {
    be_tool("echo 'tool: error: no pixels' >&2; echo bye; false");
    const Outcome failed = run();
    EXPECT_EQ(failed.state, State::kFailed);
    EXPECT_EQ(failed.why, "tool: error: no pixels");
    be_tool("echo 'tool: --quality: too large' >&2; exit 2");
    EXPECT_EQ(run().state, State::kRefused);
    be_tool("echo half > \"$output\"; kill -9 $$");
    const Outcome killed = run();
    EXPECT_EQ(killed.state, State::kFailed);
    EXPECT_NE(killed.why.find("signal 9"), std::string::npos) << killed.why;
    be_tool(":");
    EXPECT_EQ(run().state, State::kFailed) << "there is no result";
    order_.tool = "hammer";
    EXPECT_EQ(run().state, State::kFailed) << "there is no tool";
}

TEST_F(FarmToolJob, HalfAResultIsNone) {
    be_tool("echo half > \"$output\"; kill -9 $$");
    ASSERT_EQ(run().state, State::kFailed);
    be_tool("cat \"$1/photo\" > \"$output\"");
    const Outcome made = run();
    EXPECT_EQ(made.state, State::kMade);
    EXPECT_EQ(text_in(made.staged), "pixels");
}

TEST_F(FarmToolJob, WhatIsDroppedEnds) {
    be_tool("echo $$ > " + (folder_ / "pid").string() + "; exec sleep 1000");
    auto job = begin_tool_jobs({.tools = folder_.path(), .processors = {}})(to_json(order_), nullptr);
    pid_t process = 0;
    while (process == 0) {
        EXPECT_FALSE(job->poll());
        std::ifstream(folder_ / "pid") >> process;
    }
    job.reset();
    EXPECT_NE(::kill(process, 0), 0);
}

}  // namespace
}  // namespace rs::farm
