#pragma once
// Serial stand-in for the templates of oneTBB that the core uses; oneTBB has no WebAssembly build. The build links this
// file under the names <tbb/blocked_range.h>, <tbb/parallel_for.h> and <tbb/enumerable_thread_specific.h>, so that the
// sources of the core are the same everywhere. Results do not depend on the number of threads.

#include <cstddef>

namespace tbb {

template <class Index>
class blocked_range {
public:
    blocked_range(Index begin, Index end, std::size_t) : begin_(begin), end_(end) {}
    [[nodiscard]] Index begin() const { return begin_; }
    [[nodiscard]] Index end() const { return end_; }

private:
    Index begin_;
    Index end_;
};

template <class Index, class Work>
void parallel_for(Index begin, Index end, const Work& work) {
    for (Index i = begin; i < end; ++i) work(i);
}

template <class Index, class Work>
void parallel_for(const blocked_range<Index>& range, const Work& work) {
    if (range.begin() < range.end()) work(range);
}

template <class T>
class enumerable_thread_specific {
public:
    T& local() { return value_; }

private:
    T value_{};
};

}  // namespace tbb
