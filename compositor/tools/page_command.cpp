#include "compositor/tools/commands.hpp"
#include "compositor/web/page/page.hpp"
#include "rayspace/file/file_output.hpp"
#include "rayspace/tool/tool_main.hpp"

#include <memory>

namespace rs::compositor {
namespace {

struct PageCommandOptions {
    std::string object;
    std::string page;
    std::string site;
    web::PageOptions page_options;
    bool force = false;
};

Status run_page(const PageCommandOptions& options) {
    if (options.site.empty()) return web::write_page(options.object, options.page, options.page_options);
    return web::write_site(options.object, options.site, options.page_options, options.force);
}

}  // namespace

void add_page_command(CLI::App& app, std::function<Status()>& run) {
    auto options = std::make_shared<PageCommandOptions>();
    CLI::App* command = app.add_subcommand("page", "Write an object as a web page that visitors can turn");
    command->add_option("OBJECT", options->object, "object to show, FILE.rso")->required()->type_name("");
    CLI::Option* const page =
        command->add_option("-o,--output", options->page, "one page with everything inside, FILE.html; opens from disk")
            ->check(ends_in({".html", ".htm"}))
            ->type_name("");
    CLI::Option* const site =
        command->add_option("--site", options->site, "instead, a folder for a web server: page, script, module, object")
            ->type_name("FOLDER")
            ->excludes(page);
    command->add_option("--title", options->page_options.title, "title of the page; default: the object's name")
        ->type_name("TEXT");
    command
        ->add_option("--alt", options->page_options.description,
                     "description for visitors who do not see the object; default: the title")
        ->type_name("TEXT");
    command->add_flag("--force", options->force, kForceHelp)->needs(site);
    command->footer(
        "The page renders the object in the browser, with the same bits as rs-engine. It needs WebAssembly with SIMD\n"
        "(Chromium 91, Firefox 113, Safari 16.4). To embed the element <ray-space> in your own page: docs/web.md.\n"
        "Examples:\n"
        "  rs-view page shoe.rso -o shoe.html\n"
        "  rs-view page shoe.rso --site public/shoe --title \"Running shoe\" --alt \"White running shoe, size 42\"");
    command->callback([options, page, site, &run] {
        if (page->empty() && site->empty()) throw CLI::RequiredError("--output FILE.html or --site FOLDER");
        run = [options] { return run_page(*options); };
    });
}

}  // namespace rs::compositor
