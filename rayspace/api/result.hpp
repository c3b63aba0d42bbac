#pragma once
/// \file
/// Errors: Result<T>, Status and Error, under the names of the library's namespace.

#include "rayspace/api/types/result.hpp"

namespace rs::api {

using rs::Error;   ///< \copybrief rs::Error
using rs::Result;  ///< \copybrief rs::Result
using rs::Status;  ///< \copybrief rs::Status

}  // namespace rs::api
