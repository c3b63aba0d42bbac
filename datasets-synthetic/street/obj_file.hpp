#pragma once
// A World as an OBJ file and its material library. Pure; numbers do not depend on the locale.

#include "datasets-synthetic/showroom/world.hpp"

#include <set>
#include <string>

namespace rs::synthetic {

struct ObjTexts {
    std::string obj;  // one `o` for each room of the world, in alphabetical order
    std::string mtl;
};

// Looks in `unlit` show their colour or image as it is (illum 0); "shop_glass" lets most through. Colours are written
// as linear light; ambient reflectances are the diffuse ones.
ObjTexts obj_texts(const World& world, const std::string& library, const std::set<std::string>& unlit);

// With up to four digits behind the point.
std::string obj_number(double value);

}  // namespace rs::synthetic
