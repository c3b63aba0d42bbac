#pragma once
// Writes an object as a web page with the custom element <ray-space> (docs/web.md).

#include "rayspace/base/result.hpp"

#include <filesystem>
#include <string>

namespace rs::web {

struct PageOptions {
    std::string title;        // empty: the object's name
    std::string description;  // for visitors who do not see the object; empty: from the title
};

/// Writes one HTML file that contains object, script, module and a poster, and needs neither server nor network.
/// \return error if the object cannot be read, or needs more memory than a page has
Status write_page(const std::filesystem::path& object, const std::filesystem::path& html, const PageOptions& options);

/// Writes a folder for a web server: index.html, ray-space.js, ray-space.wasm, a poster, and the object.
Status write_site(const std::filesystem::path& object, const std::filesystem::path& folder, const PageOptions& options,
                  bool force);

}  // namespace rs::web
