#pragma once
// Flags of rs-view before 0.41 that are options of a subcommand now.

#include <string>
#include <vector>

namespace rs::compositor {

/// Throws a CLI::ParseError if `arguments`, which `rs-view open` does not know, is not empty. The message names the
/// subcommand that has the option.
void refuse_unknown_arguments(const std::vector<std::string>& arguments);

}  // namespace rs::compositor
