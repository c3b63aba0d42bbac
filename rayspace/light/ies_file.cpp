// IES LM-63 reader: labels, TILT=, then numbers with arbitrary line breaks. Sources: ANSI/IESNA LM-63-2002; I. Ashdown,
// "Parsing the IESNA LM-63 photometric data file", 1998, for the older editions.

#include "rayspace/base/utf8.hpp"
#include "rayspace/file/file_output.hpp"
#include "rayspace/file/input_file.hpp"
#include "rayspace/light/luminaire.hpp"
#include "rayspace/light/photometric_text.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <optional>
#include <tuple>

namespace rs {
namespace {

constexpr double kMetresPerFoot = 0.3048;
constexpr int kMaxTiltAngles = 1024;

enum class Edition { k1986, k1991, k1995, k2002, k2019 };

struct EditionName {
    std::string_view first_line;
    Edition edition;
    const char* format;
};
constexpr std::array kEditions = {
    EditionName{"IESNA91", Edition::k1991, "LM-63-1991"},
    EditionName{"IESNA:LM-63-1995", Edition::k1995, "LM-63-1995"},
    EditionName{"IESNA:LM-63-2002", Edition::k2002, "LM-63-2002"},
    EditionName{"IES:LM-63-2019", Edition::k2019, "LM-63-2019"},
};
constexpr EditionName kFirstEdition{"", Edition::k1986, "LM-63-1986"};  // no identification line

// Upper-case text without spaces: editors and tools write "IESNA: LM-63-2002" and "tilt = none".
std::string compact(std::string_view line) {
    std::string text = utf8_text(line);
    std::erase(text, ' ');
    std::ranges::transform(text, text.begin(), [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
    return text;
}

const EditionName& edition_of(std::string_view first_line) {
    const std::string line = compact(first_line);
    const auto* const found =
        std::ranges::find_if(kEditions, [&](const EditionName& name) { return line.starts_with(name.first_line); });
    return found == kEditions.end() ? kFirstEdition : *found;
}

// Parses "[KEYWORD] text"; [MORE] continues the previous line.
void add_keyword(std::string_view line, std::vector<std::pair<std::string, std::string>>& keywords) {
    const std::string text = utf8_text(line);
    const std::size_t close = text.find(']');
    if (!text.starts_with('[') || close == std::string::npos) {
        if (!text.empty()) keywords.emplace_back("", text);
        return;
    }
    const std::string keyword = text.substr(1, close - 1);
    const std::string value = utf8_text(std::string_view(text).substr(close + 1));
    if (keyword == "MORE" && !keywords.empty()) {
        keywords.back().second += ' ' + value;
    } else {
        keywords.emplace_back(keyword, value);
    }
}

// Opening shape from the signs and zeros of the three dimensions: LM-63-1995 and -2002, table 1. The second diameter of
// round openings is 0 in one edition and repeated in the other.
LuminousOpening opening_of(double across, double along, double height, Edition edition) {
    LuminousOpening opening{OpeningShape::kPoint, std::abs(across), std::abs(along), std::abs(height)};
    const bool round = across < 0 || along < 0;
    if (round || height < 0) {
        if (across == 0 && !(height < 0 && along > 0)) opening.across_m = opening.along_m;
        if (along == 0 && !(height < 0 && across > 0)) opening.along_m = opening.across_m;
    }
    const bool lying = height < 0 && edition >= Edition::k2002 && (across < 0) != (along < 0);
    if (across == 0 && along == 0 && height == 0) {
        opening.shape = OpeningShape::kPoint;
    } else if (height < 0 && ((across == 0 && along > 0) || (lying && along > 0))) {
        opening.shape = OpeningShape::kCylinderAlong;
        opening.across_m = opening.height_m;
    } else if (height < 0 && ((along == 0 && across > 0) || (lying && across > 0))) {
        opening.shape = OpeningShape::kCylinderAcross;
        opening.along_m = opening.height_m;
    } else if (height < 0) {
        opening.shape = OpeningShape::kEllipsoid;
    } else if (round) {
        opening.shape = height == 0 ? OpeningShape::kDisc : OpeningShape::kCylinder;
    } else {
        opening.shape = height == 0 ? OpeningShape::kRectangle : OpeningShape::kBox;
    }
    return opening;
}

Result<TiltTable> read_tilt(NumberStream& numbers) {
    TiltTable tilt;
    RS_ASSIGN_OR_RETURN(const int geometry, numbers.next_integer("the lamp-to-luminaire geometry of TILT", 1, 3));
    tilt.lamp_to_luminaire = geometry;
    RS_ASSIGN_OR_RETURN(const int count, numbers.next_integer("the number of tilt angles", 1, kMaxTiltAngles));
    RS_ASSIGN_OR_RETURN(std::vector<double> angles, numbers.next(static_cast<std::size_t>(count), "tilt angle"));
    if (!std::is_sorted(angles.begin(), angles.end())) return numbers.error("tilt angles must ascend");
    RS_ASSIGN_OR_RETURN(std::vector<double> factors, numbers.next(static_cast<std::size_t>(count), "tilt factor"));
    if (std::ranges::any_of(factors, [](double f) { return f < 0; })) {
        return numbers.error("a tilt factor is negative");
    }
    tilt.angles_deg = std::move(angles);
    tilt.factors = std::move(factors);
    return tilt;
}

// The ten numbers after TILT, and the three that follow.
struct Header {
    double multiplier, across, along, height, ballast_factor, last_factor, input_w, lumens_per_lamp, metres_per_unit;
    int lamps, vertical, horizontal;
    Goniometer type;
};

Result<Header> read_header(NumberStream& numbers) {
    Header header{};
    std::optional<Error> failed;
    const auto real = [&](const char* what) {
        if (failed) return 0.0;
        const Result<double> number = numbers.next(what);
        if (!number) failed = number.error();
        return number ? *number : 0.0;
    };
    const auto whole = [&](const char* what, int least, int most) {
        if (failed) return least;
        const Result<int> number = numbers.next_integer(what, least, most);
        if (!number) failed = number.error();
        return number ? *number : least;
    };
    constexpr int kMost = static_cast<int>(PhotometricWeb::kMaxAngles);
    header.lamps = whole("the number of lamps", 0, 1'000'000);
    header.lumens_per_lamp = real("the lumens per lamp");
    header.multiplier = real("the candela multiplier");
    if (!failed && !(header.multiplier > 0)) failed = numbers.error("the candela multiplier must be above 0");
    header.vertical = whole("the number of vertical angles", 2, kMost);
    header.horizontal = whole("the number of horizontal angles", 1, kMost);
    constexpr std::array kTypes = {Goniometer::kTypeC, Goniometer::kTypeB, Goniometer::kTypeA};
    header.type = kTypes.at(static_cast<std::size_t>(whole("the photometric type (1 = C, 2 = B, 3 = A)", 1, 3) - 1));
    header.metres_per_unit = whole("the unit (1 = feet, 2 = metres)", 1, 2) == 1 ? kMetresPerFoot : 1.0;
    header.across = real("the width of the opening");
    header.along = real("the length of the opening");
    header.height = real("the height of the opening");
    header.ballast_factor = real("the ballast factor");
    if (!failed && !(header.ballast_factor > 0)) failed = numbers.error("the ballast factor must be above 0");
    header.last_factor = real("the number behind the ballast factor");
    header.input_w = real("the input watts");
    if (failed) return *failed;
    return header;
}

// Line that begins with TILT=; labels may contain the word elsewhere.
std::optional<std::size_t> tilt_line(const std::vector<std::string_view>& lines) {
    const auto found =
        std::ranges::find_if(lines, [](std::string_view line) { return compact(line).starts_with("TILT="); });
    if (found == lines.end()) return std::nullopt;
    return static_cast<std::size_t>(found - lines.begin());
}

// Value of TILT: the words NONE and INCLUDE in upper case, names as written.
std::string tilt_word(std::string_view line) {
    const std::string word = utf8_text(line.substr(line.find('=') + 1));
    const std::string upper = compact(word);
    return upper == "NONE" || upper == "INCLUDE" ? upper : word;
}

Error line_error(const std::string& name, std::size_t line, const std::string& problem) {
    return Error{name + ": line " + std::to_string(line + 1) + ": " + problem};
}

}  // namespace

Result<Luminaire> parse_ies(std::string_view text, const std::string& name) {
    const std::vector<std::string_view> lines = split_lines(without_byte_order_mark(text));
    const auto tilt_at = tilt_line(lines);
    if (!tilt_at) return Error{name + ": no line begins with TILT=; use an IES file (LM-63)"};
    Luminaire luminaire;
    // Editors leave blank lines at the beginning.
    const auto first = std::ranges::find_if(lines, [](std::string_view line) { return !utf8_text(line).empty(); });
    const auto first_at = static_cast<std::size_t>(first - lines.begin());
    const EditionName& edition = edition_of(*first);
    luminaire.format = edition.format;
    for (std::size_t i = edition.edition == Edition::k1986 ? first_at : first_at + 1; i < *tilt_at; ++i) {
        add_keyword(lines[i], luminaire.keywords);
    }
    NumberStream numbers(name, lines, *tilt_at + 1);
    const std::string tilt = tilt_word(lines[*tilt_at]);
    if (tilt == "INCLUDE") {
        RS_ASSIGN_OR_RETURN(TiltTable table, read_tilt(numbers));
        luminaire.tilt = std::move(table);
    } else if (tilt != "NONE") {
        return line_error(
            name, *tilt_at,
            "TILT= names another file, '" + tilt + "', which is not beside this one; put it there, or write TILT=NONE");
    }
    RS_ASSIGN_OR_RETURN(const Header header, read_header(numbers));
    luminaire.type = header.type;
    luminaire.lamps = header.lamps;
    luminaire.lumens_per_lamp = header.lumens_per_lamp < 0 ? -1 : header.lumens_per_lamp;
    luminaire.multiplier = header.multiplier;
    luminaire.ballast_factor = header.ballast_factor;
    luminaire.input_w = header.input_w;
    // Until 1991 the last number was the ballast-lamp photometric factor.
    if (edition.edition <= Edition::k1991 && header.last_factor > 0) luminaire.ballast_factor *= header.last_factor;
    const double unit = header.metres_per_unit;
    luminaire.opening = opening_of(header.across * unit, header.along * unit, header.height * unit, edition.edition);

    PhotometricTable table{header.type, {}, {}, {}};
    const auto rows = static_cast<std::size_t>(header.vertical);
    const auto planes = static_cast<std::size_t>(header.horizontal);
    if (rows * planes > PhotometricWeb::kMaxValues) {
        return numbers.error(std::to_string(planes) + " planes of " + std::to_string(rows) +
                             " intensities are too many; " + std::to_string(PhotometricWeb::kMaxValues) +
                             " are allowed in all");
    }
    for (auto [into, count, what] : {std::tuple{&table.vertical_deg, rows, "vertical angle"},
                                     std::tuple{&table.horizontal_deg, planes, "horizontal angle"},
                                     std::tuple{&table.candela, rows * planes, "intensity"}}) {
        RS_ASSIGN_OR_RETURN(std::vector<double> read, numbers.next(count, what));
        *into = std::move(read);
    }
    for (double& value : table.candela) value *= luminaire.multiplier * luminaire.ballast_factor;
    Result<PhotometricWeb> web = PhotometricWeb::create(table);
    if (!web) return Error{name + ": " + web.error().message};
    luminaire.web = std::move(*web);
    return luminaire;
}

Result<Luminaire> read_luminaire(const std::filesystem::path& path) {
    const auto read_text = [](const std::filesystem::path& from) -> Result<std::string> {
        RS_ASSIGN_OR_RETURN(const auto bytes, read_file(from, kMaxLuminaireFile_bytes));
        return std::string(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    };
    RS_ASSIGN_OR_RETURN(std::string text, read_text(path));
    if (is_utf16(text)) return Error{path.string() + ": is UTF-16 text; save it as UTF-8"};
    if (lower_case_extension(path) == ".ldt") return parse_eulumdat(text, path.string());
    const std::vector<std::string_view> lines = split_lines(text);
    if (const auto at = tilt_line(lines)) {
        const std::string named = tilt_word(lines[*at]);
        const std::filesystem::path beside = path.parent_path() / named;
        // Uses the file name only: folders refer to the manufacturer's machine.
        const bool plain =
            named != "NONE" && named != "INCLUDE" && !named.empty() && named.find('/') == std::string::npos;
        std::error_code none;
        if (plain && std::filesystem::exists(beside, none)) {
            RS_ASSIGN_OR_RETURN(const std::string tilt, read_text(beside));
            const auto offset = static_cast<std::size_t>(lines[*at].data() - text.data());
            text.replace(offset, lines[*at].size(), "TILT=INCLUDE\n" + tilt);
        }
    }
    return parse_ies(text, path.string());
}

}  // namespace rs
