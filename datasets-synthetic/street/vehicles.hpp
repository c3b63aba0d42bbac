#pragma once
// Cars, vans and buses (traffic.hpp, vehicle_models()), as objects of one model file. Pure.

#include "datasets-synthetic/showroom/world.hpp"

#include <set>
#include <string>

namespace rs::synthetic {

// Each drives towards +X, its wheels on y = 0. Lamps shine by themselves at night: their looks are added to `unlit`.
World make_vehicles(bool night, std::set<std::string>& unlit);

}  // namespace rs::synthetic
