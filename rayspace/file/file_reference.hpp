#pragma once
// Resolves references from one file to another: URLs of VRML and X3D, URIs of glTF, file names of MTL and of capture
// sets. Files from other machines spell them in many ways.

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace rs {

/// First existing file of: the reference as written; with "%20" decoded; with "\" as separator; with both; each of
/// these in any letter case; the longest end of it that exists in the folder ("images/1.png" or "1.png" for an absolute
/// path "C:\a\images\1.png" of another machine). If none exists, the decoded path, for error messages. A leading
/// "file:" is removed. Thread-safe.
/// \param folder folder of the referring file
/// \return nullopt if the reference is empty or to another host ("http:", "urn:", "data:")
std::optional<std::filesystem::path> resolve_reference(std::string_view reference, const std::filesystem::path& folder);

/// Decodes the percent-encoding ("%20") of URIs.
std::string decode_uri(std::string_view uri);

}  // namespace rs
