#pragma once
/// \file
/// Runs other programs, such as COLMAP or a converter of scenes, without a shell.

#include "rayspace/base/result.hpp"

#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace rs {

/// Receives each line of a program's output, stdout and stderr together, without its end.
using OutputLine = std::function<void(std::string_view line)>;

/// Runs `words[0]`, searched in PATH, with the arguments `words[1..]`, and waits for it. Its stdin is empty.
/// \param on_line  called on this thread; empty: the output goes to this program's stderr.
/// \return the exit status, or 128 plus the number of the signal that ended it. Error: the program cannot be started
///         (the reason alone, such as "No such file or directory").
Result<int> run_program(const std::vector<std::string>& words, const OutputLine& on_line = {});

}  // namespace rs
