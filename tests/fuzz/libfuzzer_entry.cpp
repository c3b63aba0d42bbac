// Entry point of libFuzzer; RAYSPACE_FUZZ_ENTRY is the entry of this program (entries.hpp).
#include "tests/fuzz/entries.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    return rs::fuzz::RAYSPACE_FUZZ_ENTRY(data, size);
}
