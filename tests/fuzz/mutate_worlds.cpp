// mutate_worlds COUNT SEED WORLD.wrl...: reads COUNT mutations of the worlds in this process, and prints the numbers of
// accepted and rejected ones, and the longest time. A crash ends the program, as does a mutation that takes more than
// 20 s. The current mutation is stored in mutation.wrl in the working folder.
#include "compositor/scene/reader/vrml_file.hpp"
#include "rayspace/file/file_output.hpp"
#include "tests/fuzz/entries.hpp"
#include "tests/fuzz/mutated_world.hpp"

#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <map>

int main(int argc, char** argv) {
    using namespace rs;
    if (argc < 4) {
        std::fprintf(stderr, "usage: mutate_worlds COUNT SEED WORLD.wrl...\n");
        return 2;
    }
    std::vector<std::string> worlds;
    for (int i = 3; i < argc; ++i) {
        const auto bytes = read_file(argv[i], std::uint64_t{1} << 24);
        if (!bytes) {
            std::fprintf(stderr, "mutate_worlds: error: %s\n", bytes.error().message.c_str());
            return 1;
        }
        worlds.emplace_back(reinterpret_cast<const char*>(bytes->data()), bytes->size());
    }
    const long count = std::atol(argv[1]);
    std::mt19937_64 random(static_cast<std::uint64_t>(std::atoll(argv[2])));
    long read = 0;
    double longest_s = 0;
    for (long i = 0; i < count; ++i) {
        const std::string world = fuzz::mutated_world(worlds, random);
        std::ofstream("mutation.wrl", std::ios::binary) << world;
        alarm(20);
        const auto begun = std::chrono::steady_clock::now();
        fuzz::fuzz_vrml(reinterpret_cast<const std::uint8_t*>(world.data()), world.size());
        longest_s =
            std::max(longest_s, std::chrono::duration<double>(std::chrono::steady_clock::now() - begun).count());
        read += compositor::scene_from_vrml(world, "input.wrl").ok();
    }
    alarm(0);
    std::printf("%ld mutations: %ld read, %ld refused, none crashed; the longest took %.2f s\n", count, read,
                count - read, longest_s);
    return 0;
}
