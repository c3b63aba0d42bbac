#include "compositor/scene/x3d/xml_text.hpp"

#include "compositor/scene/x3d/classic_writer.hpp"
#include "rayspace/base/printable.hpp"

#include <expat.h>

#include <limits>
#include <memory>
#include <new>

namespace rs::compositor::x3d {
namespace {

constexpr int kMaxElements = 1000;  // nesting depth

struct ParserState {
    XML_Parser parser = nullptr;
    ClassicWriter writer;
    int depth = 0;
    std::string fault;  // reason for stopping

    [[nodiscard]] int line() const { return static_cast<int>(XML_GetCurrentLineNumber(parser)); }
    void stop(const std::string& why) {
        fault = why;
        XML_StopParser(parser, XML_FALSE);
    }
};

// Exceptions must not pass through Expat, which is C.
template <class Work>
void guarded(void* user, const Work& work) noexcept {
    auto& state = *static_cast<ParserState*>(user);
    if (!state.fault.empty()) return;
    try {
        work(state);
    } catch (const std::bad_alloc&) {
        state.stop("not enough memory");
    }
}

void on_open(void* user, const XML_Char* name, const XML_Char** pairs) {
    guarded(user, [&](ParserState& state) {
        if (++state.depth > kMaxElements) {
            return state.stop("elements nest more than " + std::to_string(kMaxElements) + " deep; flatten them");
        }
        Attributes attributes;
        for (; *pairs != nullptr; pairs += 2) attributes.emplace_back(pairs[0], pairs[1]);
        // Prefixes of XML namespaces ("x3d:Shape") are ignored.
        const std::string_view whole = name;
        state.writer.open(whole.substr(whole.find(':') + 1), attributes, state.line());
        if (!state.writer.has_root()) {
            state.stop("its root is '" + printable(whole.substr(0, 40)) +
                       "', not X3D; save the X3D element as a file of its own");
        }
    });
}

void on_close(void* user, const XML_Char* /*name*/) {
    guarded(user, [&](ParserState& state) {
        --state.depth;
        state.writer.close(state.line());
    });
}

void on_entity(void* user, const XML_Char* /*name*/, int /*is_parameter*/, const XML_Char* /*value*/, int /*length*/,
               const XML_Char* /*base*/, const XML_Char* /*system*/, const XML_Char* /*public_id*/,
               const XML_Char* /*notation*/) {
    guarded(user, [&](ParserState& state) { state.stop("it declares entities; replace them by their text"); });
}

struct ParserCloser {
    void operator()(XML_Parser parser) const { XML_ParserFree(parser); }
};

}  // namespace

bool is_xml(std::string_view text) {
    using namespace std::string_view_literals;
    if (text.starts_with("\xff\xfe<\0"sv) || text.starts_with("\xfe\xff\0<"sv)) return true;  // UTF-16
    if (text.starts_with("\xef\xbb\xbf")) text.remove_prefix(3);
    const std::size_t begin = text.find_first_not_of(" \t\r\n");
    return begin != std::string_view::npos && text[begin] == '<';
}

Result<std::string> classic_text(std::string_view xml, const std::string& file) {
    const std::unique_ptr<XML_ParserStruct, ParserCloser> parser(XML_ParserCreate(nullptr));
    if (!parser || xml.size() > static_cast<std::size_t>(std::numeric_limits<int>::max())) {
        return Error{file + ": is too large to be read; make it smaller"};
    }
    ParserState state;
    state.parser = parser.get();
    XML_SetUserData(parser.get(), &state);
    XML_SetElementHandler(parser.get(), on_open, on_close);
    XML_SetEntityDeclHandler(parser.get(), on_entity);
    const XML_Status status = XML_Parse(parser.get(), xml.data(), static_cast<int>(xml.size()), XML_TRUE);
    if (!state.fault.empty() || status != XML_STATUS_OK) {
        const std::string why = !state.fault.empty() ? state.fault
                                                     : std::string("is not well-formed XML: ") +
                                                           XML_ErrorString(XML_GetErrorCode(parser.get()));
        return Error{file + ": line " + std::to_string(state.line()) + ": " + why};
    }
    return state.writer.take();
}

}  // namespace rs::compositor::x3d
