// The function that libFuzzer calls; RAYSPACE_FUZZ_ENTRY is the entry that this program fuzzes (entries.hpp).
#include "tests/fuzz/entries.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    return rs::fuzz::RAYSPACE_FUZZ_ENTRY(data, size);
}
