#include "compositor/scene/object_argument.hpp"

#include <charconv>
#include <cmath>
#include <string_view>
#include <vector>

namespace rs::compositor {
namespace {

constexpr double kMaxObjectPosition = 1e6;
constexpr double kMinObjectScale = 1e-6;

// False unless the text consists of finite numbers separated by commas.
bool parse_numbers(std::string_view text, std::vector<double>& numbers) {
    while (true) {
        double number = 0;
        const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
        if (error != std::errc{} || !(std::abs(number) <= kMaxObjectPosition)) return false;
        numbers.push_back(number);
        text.remove_prefix(static_cast<std::size_t>(end - text.data()));
        if (text.empty()) return true;
        if (text.front() != ',') return false;
        text.remove_prefix(1);
    }
}

}  // namespace

Result<RaySpaceNode> parse_object_argument(const std::string& text, const glm::dvec3& otherwise) {
    RaySpaceNode node;
    node.required = true;
    NodeTransform transform;
    transform.translation = otherwise;
    const std::size_t sign = text.rfind('@');
    std::error_code ignored;
    if (sign == std::string::npos || std::filesystem::exists(text, ignored)) {
        node.file = text;
    } else {
        node.file = text.substr(0, sign);
        std::vector<double> numbers;
        if (!parse_numbers(std::string_view(text).substr(sign + 1), numbers) || numbers.size() < 3 ||
            numbers.size() > 5) {
            return Error{
                text + ": is not an object with a position; write FILE.rso@X,Y,Z or FILE.rso@X,Y,Z,TURN_DEGREES,SCALE"};
        }
        transform.translation = {numbers[0], numbers[1], numbers[2]};
        if (numbers.size() > 3) transform.angle_rad = radians(numbers[3]);
        if (numbers.size() > 4) transform.scale = numbers[4];
        if (!(transform.scale >= kMinObjectScale)) return Error{text + ": the scale must be above 0"};
    }
    node.chain = {transform};
    return node;
}

}  // namespace rs::compositor
