#pragma once
// Trials that may take their process along: each runs in a child, and what it did not survive is told with the seed
// that repeats it.
//
// $RAYSPACE_HOSTILE_SECONDS is how long each test goes on (3 if not set), $RAYSPACE_HOSTILE_SEED where its seeds begin
// (1): the same seed makes the same trial.

#include <cstdint>
#include <functional>
#include <string>

namespace rs::test {

double hostile_seconds();
std::uint64_t hostile_seed();

struct Limits {
    unsigned trial_s = 20;                      // a trial that takes longer hangs
    std::int64_t memory_bytes = 3'000'000'000;  // resident, of a child that runs many trials
};

// Runs trial(seed), trial(seed + 1), ... until time is over. A trial fails its test by returning what is wrong; an
// empty text is success. Children run trials one after another; a new one is made after one that died. The number of
// trials. Nothing in the calling process may have started threads.
int survive(const std::function<std::string(std::uint64_t seed)>& trial, const Limits& limits = {});

}  // namespace rs::test
