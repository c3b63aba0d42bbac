#pragma once
// The loop over many things that know nothing of one another, on the threads of the calling tbb arena. Work that can
// fail, is long enough for a bar of progress, or asks for threads of its own: parallel.hpp. Who includes this links
// TBB::tbb.

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <cstddef>
#include <type_traits>

namespace rs {

// Calls work(0) .. work(count - 1), in any order, several at a time.
template <class Index, class Work>
void for_each_index(Index count, const Work& work) {
    tbb::parallel_for(Index{0}, count, work);
}

// Calls work(begin, end) for ranges that together are 0 .. count - 1, none of them shorter than half of `grain` where
// there is so much: for work on an index that is shorter than a call.
template <class Index, class Work>
void for_each_range(Index count, std::type_identity_t<Index> grain, const Work& work) {
    tbb::parallel_for(tbb::blocked_range<Index>(Index{0}, count, static_cast<std::size_t>(grain)),
                      [&](const tbb::blocked_range<Index>& range) { work(range.begin(), range.end()); });
}

}  // namespace rs
