#pragma once
// Result<T>, Status and Error (rayspace/api/types/result.hpp), and macros that propagate errors:
//
//     Status print_rig(const std::filesystem::path& path) {
//         RS_ASSIGN_OR_RETURN(const Rig rig, read_rig(path));
//         RS_TRY(validate_rig(rig));
//         ...
//
// Libraries return errors; the tools print the message and exit with 1 (see tool_main.hpp).

#include "rayspace/api/types/result.hpp"

namespace rs {

// `what` is a number that a file states.
template <class Found, class Lowest, class Highest>
Error out_of_range(const std::string& what, Found found, Lowest lowest, Highest highest) {
    return Error{what + " is " + std::to_string(found) + "; it must be " + std::to_string(lowest) + ".." +
                 std::to_string(highest)};
}

}  // namespace rs

/// Evaluates an expression of type Result or Status, and returns its error from the enclosing function if it failed.
/// The value of a Result is discarded.
#define RS_TRY(...) RS_TRY_AS(RS_UNIQUE_NAME(rs_outcome_), __VA_ARGS__)

/// RS_ASSIGN_OR_RETURN(const Rig rig, read_rig(path)): declares a variable with the value of a Result, or returns the
/// Result's error from the enclosing function. The declaration must not contain a comma. It expands to several
/// statements, so it must not be the body of an `if` without braces.
#define RS_ASSIGN_OR_RETURN(declaration, ...) \
    RS_ASSIGN_OR_RETURN_AS(RS_UNIQUE_NAME(rs_outcome_), declaration, __VA_ARGS__)

#define RS_TRY_AS(outcome, ...)                                                    \
    do {                                                                           \
        if (auto&& outcome = (__VA_ARGS__); !outcome.ok()) return outcome.error(); \
    } while (false)
#define RS_ASSIGN_OR_RETURN_AS(outcome, declaration, ...) \
    auto outcome = (__VA_ARGS__);                         \
    if (!outcome.ok()) return outcome.error();            \
    declaration = std::move(outcome).value()
#define RS_UNIQUE_NAME(prefix) RS_CONCATENATE(prefix, __COUNTER__)
#define RS_CONCATENATE(first, second) RS_CONCATENATE_EXPANDED(first, second)
#define RS_CONCATENATE_EXPANDED(first, second) first##second
