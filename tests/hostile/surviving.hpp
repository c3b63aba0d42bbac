#pragma once
// Runs trials that may crash in child processes, and reports failures with the seed that repeats them.
//
// $RAYSPACE_HOSTILE_SECONDS is the duration of each test (default 3), $RAYSPACE_HOSTILE_SEED the first seed (default
// 1): the same seed gives the same trial.

#include <cstdint>
#include <functional>
#include <string>

namespace rs::test {

double hostile_seconds();
std::uint64_t hostile_seed();

struct Limits {
    unsigned trial_s = 20;                      // longer trials count as hanging
    std::int64_t memory_bytes = 3'000'000'000;  // resident memory of a child that runs many trials
};

/// Runs trial(seed), trial(seed + 1), ... until the time is over. A trial fails its test by returning an error text; an
/// empty text is success. Children run trials one after another; a crashed child is replaced. Must be called before the
/// process starts threads.
/// \return the number of trials.
int survive(const std::function<std::string(std::uint64_t seed)>& trial, const Limits& limits = {});

}  // namespace rs::test
