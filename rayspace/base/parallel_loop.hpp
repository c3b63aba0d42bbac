#pragma once
// Parallel loop over independent items on the threads of the calling tbb arena. See parallel.hpp for work that can
// fail, reports progress or requires its own threads. Targets that include this header link TBB::tbb.

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <cstddef>
#include <type_traits>

namespace rs {

/// Calls work(0) .. work(count - 1), in any order, concurrently.
template <class Index, class Work>
void for_each_index(Index count, const Work& work) {
    tbb::parallel_for(Index{0}, count, work);
}

/// Calls work(begin, end) for ranges that partition 0 .. count - 1, none shorter than half of `grain` unless count is.
/// For items whose work is shorter than a call.
template <class Index, class Work>
void for_each_range(Index count, std::type_identity_t<Index> grain, const Work& work) {
    tbb::parallel_for(tbb::blocked_range<Index>(Index{0}, count, static_cast<std::size_t>(grain)),
                      [&](const tbb::blocked_range<Index>& range) { work(range.begin(), range.end()); });
}

}  // namespace rs
