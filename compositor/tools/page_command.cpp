#include "compositor/tools/commands.hpp"
#include "compositor/tools/scene_options.hpp"
#include "compositor/viewer/views/object_scene.hpp"
#include "compositor/web/page/page.hpp"
#include "compositor/web/page/scene_page.hpp"
#include "rayspace/file/file_output.hpp"
#include "rayspace/tool/tool_main.hpp"

#include <memory>

namespace rs::compositor {
namespace {

struct PageCommandOptions {
    SceneOptions scene;
    std::string page;
    std::string site;
    web::PageOptions page_options;
    bool force = false;
};

// A single object is shown on a turntable.
bool shows_one_object(const SceneOptions& scene) {
    return scene.scene && is_object_file(*scene.scene) && scene.more_objects.empty() && scene.objects.empty() &&
           !scene.lights;
}

Status run_page(const PageCommandOptions& options) {
    if (shows_one_object(options.scene)) {
        if (options.site.empty()) return web::write_page(*options.scene.scene, options.page, options.page_options);
        return web::write_site(*options.scene.scene, options.site, options.page_options, options.force);
    }
    const std::string& output = options.site.empty() ? options.page : options.site;
    RS_ASSIGN_OR_RETURN(const Scene scene, open_scene(options.scene, {.outputs = {output}}));
    web::PageOptions page = options.page_options;
    if (page.title.empty()) page.title = std::filesystem::path(scene_name(options.scene)).stem().string();
    RS_ASSIGN_OR_RETURN(const std::vector<std::string> warnings,
                        options.site.empty() ? web::write_scene_page(scene, output, page)
                                             : web::write_scene_site(scene, output, page, options.force));
    print_warnings(warnings);
    return {};
}

}  // namespace

void add_page_command(CLI::App& app, std::function<Status()>& run) {
    auto options = std::make_shared<PageCommandOptions>();
    CLI::App* command = app.add_subcommand("page", "Write an object or a scene as a web page");
    add_scene_options(*command, options->scene);
    CLI::Option* const page =
        command->add_option("-o,--output", options->page, "one page with everything inside, FILE.html; opens from disk")
            ->check(ends_in({".html", ".htm"}))
            ->type_name("");
    CLI::Option* const site =
        command->add_option("--site", options->site, "instead, a folder for a web server: page, script, module, object")
            ->type_name("FOLDER")
            ->excludes(page);
    command
        ->add_option("--title", options->page_options.title, "title of the page; default: the object's or file's name")
        ->type_name("TEXT");
    command
        ->add_option("--alt", options->page_options.description,
                     "description for visitors who do not see the page; default: the title")
        ->type_name("TEXT");
    command->add_flag("--force", options->force, kForceHelp)->needs(site);
    command->footer(
        "One .rso file becomes a page on which visitors turn the object, with the same bits as rs-engine. A scene, or\n"
        "several objects, becomes a page on which they walk, drawn by three.js. Both need WebAssembly with SIMD\n"
        "(Chromium 91, Firefox 113, Safari 16.4). To embed them in your own page: docs/web.md.\n"
        "Examples:\n"
        "  rs-view page shoe.rso -o shoe.html\n"
        "  rs-view page shoe.rso --site public/shoe --title \"Running shoe\" --alt \"White running shoe, size 42\"\n"
        "  rs-view page showroom.wrl -o showroom.html");
    command->callback([options, page, site, &run] {
        check_scene_options(options->scene);
        if (page->empty() && site->empty()) throw CLI::RequiredError("--output FILE.html or --site FOLDER");
        run = [options] { return run_page(*options); };
    });
}

}  // namespace rs::compositor
