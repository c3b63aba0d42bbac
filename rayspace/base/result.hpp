#pragma once
// Result<T>: a value, or an Error whose one-line message names the file, the place and the remedy.
//
//     Status print_rig(const std::filesystem::path& path) {
//         RS_ASSIGN_OR_RETURN(const Rig rig, read_rig(path));
//         RS_TRY(validate_rig(rig));
//         ...
//
// Libraries return errors and neither print nor exit; the tools print the message and exit with 1 (see tool_main.hpp).

#include "rayspace/base/check.hpp"

#include <optional>
#include <string>
#include <utility>
#include <variant>

namespace rs {

struct Error {
    std::string message;  // one line, no final newline: "FILE: what is wrong at which place; what to do about it"
};

/// Error for a number from a file, named `what`, that is out of range.
template <class Found, class Lowest, class Highest>
Error out_of_range(const std::string& what, Found found, Lowest lowest, Highest highest) {
    return Error{what + " is " + std::to_string(found) + "; it must be " + std::to_string(lowest) + ".." +
                 std::to_string(highest)};
}

template <class T>
class [[nodiscard]] Result {
public:
    Result(T value) : content_(std::in_place_index<0>, std::move(value)) {}
    Result(Error error) : content_(std::in_place_index<1>, std::move(error)) {}

    [[nodiscard]] bool ok() const { return content_.index() == 0; }
    explicit operator bool() const { return ok(); }

    [[nodiscard]] T& value() & {
        RS_CHECK(ok());
        return std::get<0>(content_);
    }
    [[nodiscard]] const T& value() const& {
        RS_CHECK(ok());
        return std::get<0>(content_);
    }
    [[nodiscard]] T&& value() && {
        RS_CHECK(ok());
        return std::get<0>(std::move(content_));
    }
    T& operator*() & { return value(); }
    const T& operator*() const& { return value(); }
    T&& operator*() && { return std::move(*this).value(); }
    T* operator->() { return &value(); }
    const T* operator->() const { return &value(); }

    [[nodiscard]] const Error& error() const {
        RS_CHECK(!ok());
        return std::get<1>(content_);
    }

private:
    std::variant<T, Error> content_;
};

/// Result of an operation that has nothing to return.
class [[nodiscard]] Status {
public:
    Status() = default;
    Status(Error error) : error_(std::move(error)) {}

    [[nodiscard]] bool ok() const { return !error_.has_value(); }
    explicit operator bool() const { return ok(); }
    [[nodiscard]] const Error& error() const {
        RS_CHECK(error_.has_value());
        return *error_;
    }

private:
    std::optional<Error> error_;
};

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
