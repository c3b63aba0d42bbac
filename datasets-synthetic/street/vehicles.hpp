#pragma once
// Models of cars, vans and buses (traffic.hpp, vehicle_models()) as objects of one model file. Pure.

#include "datasets-synthetic/showroom/world.hpp"

#include <set>
#include <string>

namespace rs::synthetic {

// Vehicles face +X with their wheels on y = 0. At night lamps are emissive: their looks are added to `unlit`.
World make_vehicles(bool night, std::set<std::string>& unlit);

}  // namespace rs::synthetic
