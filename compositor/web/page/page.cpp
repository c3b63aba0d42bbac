#include "compositor/web/page/page.hpp"

#include "compositor/scene/export/gltf_file.hpp"
#include "compositor/web/page/page_document.hpp"
#include "compositor/web/page/web_assets.hpp"
#include "compositor/web/view/object_view.hpp"
#include "rayspace/file/file_output.hpp"
#include "rayspace/format/object_file.hpp"
#include "rayspace/image_io/image_io.hpp"
#include "rayspace/page/html_page.hpp"

#include <vector>

namespace rs::web {
namespace {

constexpr std::uint64_t kMaxObject_bytes = std::uint64_t{256} << 20;  // browsers limit the length of an address
constexpr int kPosterSide_px = 480;
constexpr int kInlinePosterSide_px = 320;  // of a page whose object, which takes its place at once, is inside
constexpr const char* kContents = "a web page";

constexpr const char* kStyle =
    "ray-space{width:100%;height:100%}"
    "noscript img{width:100%;height:100%;object-fit:contain}";

struct PageObject {
    std::vector<std::byte> file;
    std::string name;
    std::vector<std::byte> poster;  // PNG
};

// Opens the object as the page will, so that the page cannot fail on it.
Result<PageObject> read_page_object(const std::filesystem::path& path, int poster_side_px) {
    PageObject object;
    RS_ASSIGN_OR_RETURN(object.file, read_file(path, kMaxObject_bytes));
    RS_ASSIGN_OR_RETURN(ObjectView view, ObjectView::open(object.file, path.string(), kProgressiveLevels - 1));
    object.name = view.object().name.empty() ? path.stem().string() : view.object().name;
    const CapturedCamera& captured = view.captured().front();
    RS_TRY(
        view.render({poster_side_px, poster_side_px, captured.azimuth_rad, captured.elevation_rad, captured.distance}));
    RS_ASSIGN_OR_RETURN(object.poster, encode_png(view.image(), "poster"));
    return object;
}

// Addresses of the page's files.
struct Addresses {
    std::string object;
    std::string poster;
    std::string core;  // empty: beside the script
};

std::string html(const PageOptions& options, const std::string& name, const Addresses& addresses,
                 const std::string& script_element) {
    const std::string title = escaped(options.title.empty() ? name : options.title);
    const std::string description = options.description.empty() ? title : escaped(options.description);
    std::string content =
        "<ray-space alt=\"" + description + "\" camera-controls auto-rotate\n  poster=\"" + addresses.poster + "\"";
    if (!addresses.core.empty()) content += "\n  core=\"" + addresses.core + "\"";
    content += "\n  src=\"" + addresses.object + "\"></ray-space>\n<noscript><img alt=\"" + description + "\" src=\"" +
               addresses.poster + "\"></noscript>\n";
    return page_document(title, kStyle, content, script_element);
}

}  // namespace

Status write_page(const std::filesystem::path& object, const std::filesystem::path& html_file,
                  const PageOptions& options) {
    RS_ASSIGN_OR_RETURN(const WebAssets assets, web_assets());
    RS_TRY(refuse_overwriting_inputs(html_file, {object}));
    RS_ASSIGN_OR_RETURN(const PageObject shown, read_page_object(object, kInlinePosterSide_px));
    const Addresses addresses{data_url("application/octet-stream", shown.file), data_url("image/png", shown.poster),
                              data_url("application/gzip", assets.compressed_module)};
    const std::string script = "<script>" + std::string(assets.script) + "</script>";
    return write_file(html_file, html(options, shown.name, addresses, script));
}

Status write_site(const std::filesystem::path& object, const std::filesystem::path& folder, const PageOptions& options,
                  bool force) {
    RS_ASSIGN_OR_RETURN(const WebAssets assets, web_assets());
    RS_TRY(refuse_overwriting_inputs(folder, {object}));
    RS_ASSIGN_OR_RETURN(const PageObject shown, read_page_object(object, kPosterSide_px));
    RS_ASSIGN_OR_RETURN(StagedFolder staged, StagedFolder::create(folder, kContents, force));
    const std::filesystem::path& into = staged.temporary_path();
    const std::string file_name = object.filename().string();
    const std::string page = html(options, shown.name, {compositor::url_of_path(file_name), "poster.png", ""},
                                  "<script src=\"ray-space.js\"></script>");
    RS_TRY(write_file(into / file_name, shown.file));
    RS_TRY(write_file(into / "poster.png", shown.poster));
    RS_TRY(write_file(into / "ray-space.js", std::string(assets.script)));
    RS_TRY(write_file(into / "ray-space.wasm", assets.module));
    RS_TRY(write_file(into / "index.html", page));
    return staged.commit();
}

}  // namespace rs::web
