#pragma once
/// \file
/// ExecutorTable: executors by the names that the tools take with --executor.

#include "rayspace/api/types/executor.hpp"
#include "rayspace/api/types/result.hpp"

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace rs::engine {

/// An executor that can be created by name.
struct ExecutorEntry {
    std::string name;      ///< without a colon
    std::string argument;  ///< what follows the name after a colon, such as "CONFIG"; empty if it takes no argument
    /// Creates the executor, or fails with the reason; `argument` is the text after the colon.
    std::function<Result<std::unique_ptr<Executor>>(const std::string& argument)> create;
};

/// A list of executors: a value, which may be copied and extended. Constant functions may be called from several
/// threads at once.
class ExecutorTable {
public:
    /// The executors of the library: `core` (the fast software renderer), `scalar` (the definition) and, if built with
    /// the hardware models, `board:CONFIG` (a cycle-accurate board; CONFIG as `rs-engine simulate` takes it).
    ExecutorTable();

    /// Adds an executor.
    /// \return an error if the name is empty, has a colon or is in the table
    Status add(ExecutorEntry entry);

    /// Creates an executor.
    /// \param name  NAME or NAME:ARGUMENT, one of names()
    /// \return the executor; an error that lists the valid names, or that of the entry
    [[nodiscard]] Result<std::unique_ptr<Executor>> create(const std::string& name) const;

    /// The names, such as "scalar, core, board:CONFIG".
    [[nodiscard]] std::string names() const;

private:
    std::vector<ExecutorEntry> entries_;
};

}  // namespace rs::engine
