#pragma once
/// \file
/// Result<T>: a value, or an Error whose one-line message names the file, the place and the remedy.
///
///     rs::Status print_name(const std::filesystem::path& path) {
///         RS_ASSIGN_OR_RETURN(const rs::api::Object object, rs::api::Object::open(path));
///         std::puts(object.name().c_str());
///         return {};
///     }
///
/// The library neither prints nor exits nor throws. Access to the wrong alternative is a programming error and aborts.

#include "rayspace/api/types/check.hpp"

#include <optional>
#include <string>
#include <utility>
#include <variant>

namespace rs {

/// Reason of a failure.
struct Error {
    std::string message;  ///< one line without a newline: "FILE: what is wrong at which place; what to do about it"
};

/// A value or an Error.
template <class T>
class [[nodiscard]] Result {
public:
    /// Success.
    Result(T value) : content_(std::in_place_index<0>, std::move(value)) {}
    /// Failure.
    Result(Error error) : content_(std::in_place_index<1>, std::move(error)) {}

    /// True if there is a value.
    [[nodiscard]] bool ok() const { return content_.index() == 0; }
    /// True if there is a value.
    explicit operator bool() const { return ok(); }

    /// The value; aborts if there is none.
    [[nodiscard]] T& value() & {
        RS_CHECK(ok());
        return std::get<0>(content_);
    }
    /// \copydoc value()
    [[nodiscard]] const T& value() const& {
        RS_CHECK(ok());
        return std::get<0>(content_);
    }
    /// \copydoc value()
    [[nodiscard]] T&& value() && {
        RS_CHECK(ok());
        return std::get<0>(std::move(content_));
    }
    /// The value; aborts if there is none.
    T& operator*() & { return value(); }
    /// The value; aborts if there is none.
    const T& operator*() const& { return value(); }
    /// The value; aborts if there is none.
    T&& operator*() && { return std::move(*this).value(); }
    /// Member access of the value; aborts if there is none.
    T* operator->() { return &value(); }
    /// Member access of the value; aborts if there is none.
    const T* operator->() const { return &value(); }

    /// The error; aborts if there is a value.
    [[nodiscard]] const Error& error() const {
        RS_CHECK(!ok());
        return std::get<1>(content_);
    }

private:
    std::variant<T, Error> content_;
};

/// Success without a value, or an Error.
class [[nodiscard]] Status {
public:
    /// Success.
    Status() = default;
    /// Failure.
    Status(Error error) : error_(std::move(error)) {}

    /// True on success.
    [[nodiscard]] bool ok() const { return !error_.has_value(); }
    /// True on success.
    explicit operator bool() const { return ok(); }
    /// The error; aborts on success.
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

/// \cond internal
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
/// \endcond
