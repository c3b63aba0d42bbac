#pragma once
// Shared state of the C interface: the module's object and its last error (web_core.cpp).

#include "compositor/web/view/object_view.hpp"
#include "rayspace/base/result.hpp"

#include <emscripten/emscripten.h>

#include <optional>

#define WEB_EXPORT extern "C" EMSCRIPTEN_KEEPALIVE

namespace rs::web {

/// The object of the module, if one is open.
std::optional<ObjectView>& opened_view();

/// Keeps the message of a failure for web_error(). \return true on success
bool succeeded(const Status& status);

}  // namespace rs::web
