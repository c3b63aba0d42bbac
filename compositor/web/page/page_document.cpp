#include "compositor/web/page/page_document.hpp"

#include "rayspace/page/html_page.hpp"

namespace rs::web {
namespace {

constexpr const char* kPageStyle =
    "html,body,main{height:100%;margin:0}body{background:#f4f4f2}"
    "h1{position:absolute;width:1px;height:1px;margin:0;overflow:hidden;clip-path:inset(50%)}"
    "@media (prefers-color-scheme:dark){body{background:#16181c}}";

}  // namespace

std::string page_document(const std::string& title, const std::string& style, const std::string& content,
                          const std::string& script_element) {
    return "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
           "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n<title>" +
           title + "</title>\n<style>" + kPageStyle + style + "</style>\n</head>\n<body>\n<main>\n<h1>" + title +
           "</h1>\n" + content + "</main>\n" + script_element + "\n</body>\n</html>\n";
}

std::string data_url(const char* type, std::span<const std::byte> bytes) {
    return std::string("data:") + type + ";base64," + base64(bytes);
}

}  // namespace rs::web
