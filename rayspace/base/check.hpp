#pragma once
// RS_CHECK, which the public headers use, too.

#include "rayspace/api/types/check.hpp"
