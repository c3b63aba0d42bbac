// Kills a farm at random moments (mpirun, a rank or a tool): finished results are kept and not computed again.

#include "rayspace/file/input_list.hpp"
#include "tests/hostile/mutation.hpp"
#include "tests/hostile/surviving.hpp"
#include "tests/support/file_text.hpp"
#include "tests/support/run_mpi.hpp"
#include "tests/support/temporary_folder.hpp"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <fstream>
#include <iterator>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <thread>
#include <vector>

namespace rs {
namespace {

namespace fs = std::filesystem;
using test::text_in;

constexpr int kItems = 60;
constexpr int kRanks = 3;

pid_t parent_of(pid_t process) {
    const std::string stat = text_in("/proc/" + std::to_string(process) + "/stat");
    const std::size_t name_end = stat.rfind(')');
    if (name_end == std::string::npos || name_end + 4 > stat.size()) return 0;
    return std::atoi(stat.c_str() + name_end + 4);
}

// All descendants of `root`, starting with itself.
std::vector<pid_t> descendants(pid_t root) {
    std::vector<pid_t> found{root};
    std::error_code error;
    std::map<pid_t, pid_t> parents;
    for (const auto& entry : fs::directory_iterator("/proc", error)) {
        const pid_t process = std::atoi(entry.path().filename().c_str());
        if (process > 0) parents[process] = parent_of(process);
    }
    for (std::size_t i = 0; i < found.size(); ++i) {
        for (const auto& [process, parent] : parents) {
            if (parent == found[i]) found.push_back(process);
        }
    }
    return found;
}

std::string name_of(pid_t process) {
    return text_in("/proc/" + std::to_string(process) + "/comm");
}

class Farm {
public:
    Farm(const std::string& program, const std::vector<std::string>& arguments) {
        std::vector<std::string> words = {"mpirun", "-n", std::to_string(kRanks), program};
        words.insert(words.end(), arguments.begin(), arguments.end());
        std::vector<char*> argv;
        for (std::string& word : words) argv.push_back(word.data());
        argv.push_back(nullptr);
        process_ = ::fork();
        if (process_ == 0) {
            const int nothing = ::open("/dev/null", O_RDWR);
            for (const int stream : {0, 1, 2}) ::dup2(nothing, stream);
            ::execvp("mpirun", argv.data());
            ::_exit(127);
        }
    }
    [[nodiscard]] std::vector<pid_t> processes() const { return descendants(process_); }
    // Open MPI 4.1's mpirun may wait forever for a rank that was killed during MPI_Init: it gets ten seconds.
    void wait_then_kill() const {
        const auto late = std::chrono::steady_clock::now() + std::chrono::seconds(10);
        while (!ended()) {
            if (std::chrono::steady_clock::now() > late) ::kill(process_, SIGKILL);
            std::this_thread::sleep_for(std::chrono::milliseconds(5));
        }
        wait();
    }
    // The exit code; -1 if a signal ended mpirun.
    int wait() const {
        int status = 0;
        ::waitpid(process_, &status, 0);
        return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
    }
    [[nodiscard]] bool ended() const {
        siginfo_t info{};
        return ::waitid(P_PID, static_cast<id_t>(process_), &info, WEXITED | WNOHANG | WNOWAIT) == 0 &&
               info.si_pid == process_;
    }

private:
    pid_t process_ = 0;
};

// Finished results and the markers of complete work, none of which may be replaced.
std::map<std::string, ino_t> finished(const fs::path& objects) {
    std::map<std::string, ino_t> files;
    std::error_code error;
    for (auto at = fs::recursive_directory_iterator(objects, error); !error && at != fs::recursive_directory_iterator();
         at.increment(error)) {
        const fs::path name = at->path().filename();
        const bool counts = name == "inputs" || (name.extension() == ".rso" && at->path().parent_path() == objects);
        struct stat info {};
        if (counts && ::stat(at->path().c_str(), &info) == 0) files[at->path().string()] = info.st_ino;
    }
    return files;
}

// The number of manifest lines per item.
std::map<std::string, int> made_lines(const fs::path& manifest) {
    std::map<std::string, int> times;
    std::ifstream file(manifest);
    for (std::string line; std::getline(file, line);) {
        const auto json = nlohmann::json::parse(line, nullptr, false);
        if (json.is_discarded()) continue;  // truncated
        if (json.at("state") == "made") ++times[json.at("item")];
    }
    return times;
}

// A farm whose tool is a script that copies its input and records its completion.
class KilledFarm : public testing::Test {
protected:
    void SetUp() override {
        if (!test::has_farm()) GTEST_SKIP() << "rs-farm was not built, for there is no MPI";
        test::allow_mpi_here();
        fs::create_directories(folder_ / "bin");
        fs::copy_file(std::string(RAYSPACE_TOOLS_DIR) + "/rs-farm", folder_ / "bin/rs-farm");
        std::ofstream(folder_ / "bin/rs-encode")
            << "#!/bin/sh\nfor output; do :; done\nsleep 0.02\n"
               "cat \"$2/photo\" >\"$output.part\" && mv \"$output.part\" \"$output\" &&\n"
               "cp \"$2.inputs\" \"$RAYSPACE_INPUTS.part\" && mv \"$RAYSPACE_INPUTS.part\" \"$RAYSPACE_INPUTS\" &&\n"
               "echo \"$2\" >>"
            << (folder_ / "runs").string() << "\n";
        ::chmod((folder_ / "bin/rs-encode").c_str(), 0755);
        command_ = {"encode"};
        for (int i = 0; i < kItems; ++i) {
            const fs::path set = folder_ / ("set" + std::to_string(i));
            fs::create_directories(set);
            std::ofstream(set / "photo") << "pixels of " << i;
            const fs::path photo = set / "photo";
            std::ofstream(set.string() + ".inputs")
                << input_list_text({{photo, *sum_of_file(photo), fs::file_size(photo), 0}});
            command_.push_back(set.string());
        }
        command_.insert(command_.end(), {"-o", objects_.string(), "-q"});
    }

    // A process of a randomly chosen kind; 0 if there is none.
    static pid_t victim_of(const std::vector<pid_t>& processes, test::Random& random) {
        const std::size_t kind = test::below(random, 5);
        const std::string wanted = kind == 0 ? "mpirun\n" : kind == 1 ? "rs-encode\n" : "rs-farm\n";
        std::vector<pid_t> victims;
        for (const pid_t process : processes) {
            if (name_of(process) == wanted) victims.push_back(process);
        }
        return victims.empty() ? 0 : victims[test::below(random, victims.size())];
    }

    [[nodiscard]] int done() const {
        const std::string lines = text_in(folder_ / "runs");
        return static_cast<int>(std::ranges::count(lines, '\n'));
    }

    // Kills a process while the ranks start, or after some more items are done and a random delay. Returns false if the
    // farm was done before.
    [[nodiscard]] bool kill_something(const Farm& farm, test::Random& random) const {
        const auto is_rank = [](pid_t process) { return name_of(process) == "rs-farm\n"; };
        const int wanted = test::below(random, 8) == 0 ? 0 : done() + static_cast<int>(test::below(random, 12));
        while (std::ranges::count_if(farm.processes(), is_rank) < kRanks || done() < wanted) {
            if (farm.ended()) return false;
            std::this_thread::sleep_for(std::chrono::milliseconds(2));
        }
        std::this_thread::sleep_for(std::chrono::microseconds(test::below(random, 60'000)));
        while (!farm.ended()) {
            const pid_t victim = victim_of(farm.processes(), random);
            if (victim != 0) return ::kill(victim, SIGKILL) == 0;
        }
        return false;
    }

    void expect_results_unchanged(const std::map<std::string, ino_t>& before) const {
        for (const auto& [file, number] : before) {
            struct stat info {};
            ASSERT_EQ(::stat(file.c_str(), &info), 0) << file << " is lost";
            ASSERT_EQ(info.st_ino, number) << file << " was made twice";
        }
        for (const auto& [item, times] : made_lines(objects_ / ".rs-farm/manifest.jsonl")) ASSERT_EQ(times, 1) << item;
        std::map<std::string, int> runs;
        std::ifstream file(folder_ / "runs");
        for (std::string line; std::getline(file, line);) ASSERT_EQ(++runs[line], 1) << line << " was done twice";
    }

    void finish_and_check() const {
        ASSERT_EQ(Farm((folder_ / "bin/rs-farm").string(), command_).wait(), 0);
        const auto made = made_lines(objects_ / ".rs-farm/manifest.jsonl");
        ASSERT_EQ(made.size(), static_cast<std::size_t>(kItems));
        for (int i = 0; i < kItems; ++i) {
            EXPECT_EQ(text_in(objects_ / ("set" + std::to_string(i) + ".rso")), "pixels of " + std::to_string(i));
        }
    }

    test::TemporaryFolder folder_;
    fs::path objects_ = folder_ / "objects";
    std::vector<std::string> command_;
};

TEST_F(KilledFarm, GoesOnWhereItWas) {
    test::Random random(test::hostile_seed());
    int kills = 0;
    const auto end = std::chrono::steady_clock::now() + std::chrono::duration<double>(test::hostile_seconds());
    std::map<std::string, ino_t> before;
    do {
        const Farm farm((folder_ / "bin/rs-farm").string(), command_);
        const bool killed = kill_something(farm, random);
        kills += killed ? 1 : 0;
        farm.wait_then_kill();
        // Ranks that outlive mpirun end by themselves; the next farm waits for them.
        expect_results_unchanged(before);
        if (HasFatalFailure()) return;
        before = finished(objects_);
        if (!killed) {  // all done: start over
            finish_and_check();
            if (HasFatalFailure()) return;
            before.clear();
            fs::remove_all(objects_);
            fs::remove(folder_ / "runs");
        }
    } while (std::chrono::steady_clock::now() < end);
    EXPECT_GT(kills, 0);
    finish_and_check();
    expect_results_unchanged(before);
    RecordProperty("kills", kills);
}

}  // namespace
}  // namespace rs
