#pragma once
// Result<T>, Status and Error with RS_TRY and RS_ASSIGN_OR_RETURN (rayspace/api/types/result.hpp), and errors of
// numbers out of range. Libraries return errors; the tools print the message and exit with 1 (see tool_main.hpp).

#include "rayspace/api/types/result.hpp"

namespace rs {

// `what` is a number that a file states.
template <class Found, class Lowest, class Highest>
Error out_of_range(const std::string& what, Found found, Lowest lowest, Highest highest) {
    return Error{what + " is " + std::to_string(found) + "; it must be " + std::to_string(lowest) + ".." +
                 std::to_string(highest)};
}

}  // namespace rs
