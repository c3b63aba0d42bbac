#pragma once
// HTML documents of pages, and the addresses in them.

#include <cstddef>
#include <span>
#include <string>

namespace rs::web {

/// A page that fills the window and follows the visitor's light or dark setting. Its heading is for screen readers.
/// \param title escaped for HTML
/// \param style CSS in addition
/// \param content markup within <main>
/// \param script_element markup at the end of the body
std::string page_document(const std::string& title, const std::string& style, const std::string& content,
                          const std::string& script_element);

/// Address that contains the bytes themselves.
std::string data_url(const char* type, std::span<const std::byte> bytes);

}  // namespace rs::web
