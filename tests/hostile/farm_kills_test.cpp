// A farm that is killed at any moment, with mpirun, a rank or a tool: what was finished stays, and is not done again.

#include "rayspace/format/object_file.hpp"
#include "rayspace/geometry/rig.hpp"
#include "tests/hostile/mutation.hpp"
#include "tests/hostile/surviving.hpp"
#include "tests/support/drawn_set.hpp"
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

constexpr int kItems = 24;
constexpr int kRanks = 3;

pid_t parent_of(pid_t process) {
    const std::string stat = text_in("/proc/" + std::to_string(process) + "/stat");
    const std::size_t name_end = stat.rfind(')');
    if (name_end == std::string::npos || name_end + 4 > stat.size()) return 0;
    return std::atoi(stat.c_str() + name_end + 4);
}

// Of `root`, itself first.
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
    explicit Farm(const std::vector<std::string>& arguments) {
        std::vector<std::string> words = test::farm_command(kRanks, arguments);
        words.insert(words.begin(), "mpirun");
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
    // The exit code; -1 where a signal ended mpirun.
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

// What is finished: results in place, and the marks of work that is complete. None may be made anew.
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

// How often the manifest says of each item that it was made.
std::map<std::string, int> made_lines(const fs::path& manifest) {
    std::map<std::string, int> times;
    std::ifstream file(manifest);
    for (std::string line; std::getline(file, line);) {
        const auto json = nlohmann::json::parse(line, nullptr, false);
        if (json.is_discarded()) continue;  // cut short
        if (json.at("state") == "made") ++times[json.at("item")];
    }
    return times;
}

TEST(HostileFarm, IsKilledAndGoesOnWhereItWas) {
    if (!test::has_farm()) GTEST_SKIP() << "rs-farm was not built, for there is no MPI";
    test::allow_mpi_here();
    const test::TemporaryFolder folder;
    std::vector<std::string> command = {"encode"};
    for (int i = 0; i < kItems; ++i) {
        const std::string name = "set" + std::to_string(i);
        Rig rig = make_ring({.count = 3 + i % 4, .fl_px = 30, .width = 24, .height = 20});
        rig.object_radius = 0.9;
        test::write_drawn_set(folder / name, rig);
        command.push_back((folder / name).string());
    }
    const fs::path objects = folder / "objects";
    command.insert(command.end(), {"-o", objects.string(), "-q", "--", "--planes", "3", "--cells", "8x8"});
    test::Random random(test::hostile_seed());
    int kills = 0;
    int rounds = 0;
    const auto end = std::chrono::steady_clock::now() + std::chrono::duration<double>(test::hostile_seconds());
    std::map<std::string, ino_t> before;
    do {
        const Farm farm(command);
        // Until there is something to kill.
        std::vector<pid_t> processes;
        const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(60);
        const auto is_rank = [](pid_t process) { return name_of(process) == "rs-farm\n"; };
        while (!farm.ended() && std::chrono::steady_clock::now() < deadline) {
            processes = farm.processes();
            if (std::ranges::count_if(processes, is_rank) == kRanks) break;
            std::this_thread::sleep_for(std::chrono::milliseconds(5));
        }
        std::this_thread::sleep_for(std::chrono::microseconds(test::below(random, 600'000)));
        processes = farm.processes();
        // mpirun, or a rank, or a tool at work.
        std::vector<pid_t> victims;
        const unsigned kind = test::below(random, 5);
        for (const pid_t process : processes) {
            const std::string name = name_of(process);
            if (name == (kind == 0 ? "mpirun\n" : kind == 4 ? "rs-encode\n" : "rs-farm\n")) victims.push_back(process);
        }
        if (!victims.empty() && !farm.ended()) {
            const pid_t victim = victims[test::below(random, static_cast<unsigned>(victims.size()))];
            kills += ::kill(victim, SIGKILL) == 0 ? 1 : 0;
        }
        farm.wait();
        // Ranks that outlive mpirun end by themselves; the next farm waits for them.
        for (const auto& [file, number] : before) {
            struct stat info {};
            ASSERT_EQ(::stat(file.c_str(), &info), 0) << file << " is lost";
            ASSERT_EQ(info.st_ino, number) << file << " was made twice";
        }
        before = finished(objects);
        for (const auto& [item, times] : made_lines(objects / ".rs-farm/manifest.jsonl")) ASSERT_EQ(times, 1) << item;
        // When all is made, from the beginning.
        if (++rounds % 8 == 0) {
            const Farm last(command);
            ASSERT_EQ(last.wait(), 0);
            ASSERT_EQ(made_lines(objects / ".rs-farm/manifest.jsonl").size(), static_cast<std::size_t>(kItems));
            before.clear();
            fs::remove_all(objects);
        }
    } while (std::chrono::steady_clock::now() < end);
    EXPECT_GT(kills, 0);
    const Farm last(command);
    ASSERT_EQ(last.wait(), 0);
    const auto made = made_lines(objects / ".rs-farm/manifest.jsonl");
    ASSERT_EQ(made.size(), static_cast<std::size_t>(kItems));
    for (const auto& [item, times] : made) {
        EXPECT_EQ(times, 1) << item;
        EXPECT_TRUE(read_object(objects / (item + ".rso")).ok()) << item;
    }
    RecordProperty("kills", kills);
    std::printf("%d kills in %d runs\n", kills, rounds);
}

}  // namespace
}  // namespace rs
