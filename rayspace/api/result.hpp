#pragma once
/// \file
/// Errors: Result<T>, Status and Error, under the names of the library's namespace.

#include "rayspace/api/types/result.hpp"

/// \namespace rs
/// Types that the public library shares with the rest of the project.
/// \namespace rs::engine
/// Data of a view, executors and their table.

/// The public library.
namespace rs::api {

using rs::Error;   ///< \copybrief rs::Error
using rs::Result;  ///< \copybrief rs::Result
using rs::Status;  ///< \copybrief rs::Status

}  // namespace rs::api
