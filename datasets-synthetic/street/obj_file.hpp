#pragma once
// Converts a World to an OBJ file and its material library. Pure; numbers do not depend on the locale.

#include "datasets-synthetic/showroom/world.hpp"

#include <set>
#include <string>

namespace rs::synthetic {

struct ObjTexts {
    std::string obj;  // one `o` per room of the world, in alphabetical order
    std::string mtl;
};

// Looks in `unlit` are not shaded (illum 0); "shop_glass" is mostly transparent. Colours are written as linear light;
// ambient reflectances equal the diffuse ones.
ObjTexts obj_texts(const World& world, const std::string& library, const std::set<std::string>& unlit);

// Formats a number with up to four decimals.
std::string obj_number(double value);

}  // namespace rs::synthetic
