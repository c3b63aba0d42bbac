#include "compositor/web/page/scene_page.hpp"

#include "compositor/scene/export/gltf_file.hpp"
#include "compositor/web/page/page_document.hpp"
#include "compositor/web/page/web_assets.hpp"
#include "compositor/web/view/scene_view.hpp"
#include "rayspace/file/file_output.hpp"
#include "rayspace/page/html_page.hpp"

#include <algorithm>
#include <map>
#include <utility>

namespace rs::web {
namespace {

constexpr std::uint64_t kMaxSceneObject_bytes = std::uint64_t{256} << 20;  // browsers limit the length of an address
constexpr const char* kSiteContents = "a web page";
constexpr const char* kSceneFile = "scene.glb";
constexpr const char* kSceneStyle = "ray-space-scene{width:100%;height:100%}";

// A scene with the files of its objects, by their names on the page.
struct PageScene {
    compositor::GltfFile gltf;
    std::map<std::string, std::vector<std::byte>> objects;
};

// Names files of different folders apart.
std::string free_name(const std::filesystem::path& file, const std::map<std::string, std::vector<std::byte>>& taken) {
    std::string name = file.filename().string();
    for (int n = 2; taken.contains(name); ++n) {
        name = file.stem().string() + "-" + std::to_string(n) + file.extension().string();
    }
    return name;
}

// Opens each object as the page will, so that the page cannot fail on it.
Result<PageScene> read_page_scene(compositor::Scene scene) {
    PageScene page;
    std::map<std::filesystem::path, std::string> names;
    std::vector<std::string> warnings;
    std::vector<compositor::RaySpaceNode> shown;
    for (const compositor::RaySpaceNode& node : scene.objects) {
        if (!names.contains(node.file)) {
            Result<std::vector<std::byte>> file = read_file(node.file, kMaxSceneObject_bytes);
            const Status opened = !file ? Status(file.error()) : [&]() -> Status {
                RS_ASSIGN_OR_RETURN(const SceneObject object, SceneObject::open(*file, node.file.string()));
                return {};
            }();
            const auto requires_file = [&](const auto& each) { return each.required && each.file == node.file; };
            if (!opened && std::ranges::any_of(scene.objects, requires_file)) return opened.error();
            if (!opened) warnings.push_back(opened.error().message + "; omitted");
            const std::string name = opened ? free_name(node.file, page.objects) : "";
            if (opened) page.objects.emplace(name, std::move(*file));
            names.emplace(node.file, name);
        }
        if (!names[node.file].empty()) shown.push_back(node);
    }
    scene.objects = std::move(shown);
    RS_ASSIGN_OR_RETURN(page.gltf, compositor::export_gltf(scene, [&](const std::filesystem::path& file) {
                            return compositor::url_of_path(names.at(file));
                        }));
    // The page shows these parts of the scene.
    std::erase_if(page.gltf.warnings, [](const std::string& w) { return w.find("only pages of rs-view") != w.npos; });
    page.gltf.warnings.insert(page.gltf.warnings.begin(), warnings.begin(), warnings.end());
    return page;
}

std::string scene_html(const PageOptions& options, const std::string& attributes, const std::string& scripts) {
    const std::string title = escaped(options.title);
    const std::string description = options.description.empty() ? title : escaped(options.description);
    const std::string content = "<ray-space-scene alt=\"" + description + "\" src=\"" + kSceneFile + "\"" + attributes +
                                "></ray-space-scene>\n<noscript>This page shows " + title +
                                " in three dimensions. It needs JavaScript.</noscript>\n";
    return page_document(title, kSceneStyle, content, scripts);
}

}  // namespace

Result<std::vector<std::string>> write_scene_page(const compositor::Scene& scene, const std::filesystem::path& html,
                                                  const PageOptions& options) {
    RS_ASSIGN_OR_RETURN(const WebAssets assets, web_assets());
    RS_ASSIGN_OR_RETURN(PageScene page, read_page_scene(scene));
    std::string files = std::string("{\n\"") + kSceneFile + "\":\"" + data_url("model/gltf-binary", page.gltf.bytes);
    for (const auto& [name, bytes] : page.objects) {
        files += "\",\n\"" + compositor::url_of_path(name) + "\":\"" + data_url("application/octet-stream", bytes);
    }
    files = "<script type=\"application/json\" id=\"files\">" + files + "\"\n}</script>\n";
    const std::string core = data_url("application/gzip", assets.compressed_module);
    const std::string script = "<script>" + std::string(assets.scene_script) + "</script>";
    RS_TRY(write_file(html, scene_html(options, " files=\"files\"\n core=\"" + core + "\"", files + script)));
    return std::move(page.gltf.warnings);
}

Result<std::vector<std::string>> write_scene_site(const compositor::Scene& scene, const std::filesystem::path& folder,
                                                  const PageOptions& options, bool force) {
    RS_ASSIGN_OR_RETURN(const WebAssets assets, web_assets());
    RS_ASSIGN_OR_RETURN(PageScene page, read_page_scene(scene));
    RS_ASSIGN_OR_RETURN(StagedFolder staged, StagedFolder::create(folder, kSiteContents, force));
    const std::filesystem::path& into = staged.temporary_path();
    for (const auto& [name, bytes] : page.objects) RS_TRY(write_file(into / name, bytes));
    RS_TRY(write_file(into / kSceneFile, page.gltf.bytes));
    RS_TRY(write_file(into / "scene.js", std::string(assets.scene_script)));
    RS_TRY(write_file(into / "ray-space.wasm", assets.module));
    RS_TRY(write_file(into / "index.html", scene_html(options, "", "<script src=\"scene.js\"></script>")));
    RS_TRY(staged.commit());
    return std::move(page.gltf.warnings);
}

}  // namespace rs::web
