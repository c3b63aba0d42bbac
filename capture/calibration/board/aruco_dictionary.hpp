#pragma once
// Table of the supported ArUco dictionaries by the names of BoardDesign. Only for .cpp files of this folder: it needs
// OpenCV.

#include <opencv2/aruco/dictionary.hpp>

#include <array>
#include <string>

namespace rs::capture {

struct NamedDictionary {
    const char* name;
    cv::aruco::PREDEFINED_DICTIONARY_NAME number;
    int across;  // inner cells per side
    int markers;
};

inline constexpr std::array<NamedDictionary, 8> kDictionaries{{{"4x4_50", cv::aruco::DICT_4X4_50, 4, 50},
                                                               {"4x4_100", cv::aruco::DICT_4X4_100, 4, 100},
                                                               {"4x4_250", cv::aruco::DICT_4X4_250, 4, 250},
                                                               {"4x4_1000", cv::aruco::DICT_4X4_1000, 4, 1000},
                                                               {"5x5_50", cv::aruco::DICT_5X5_50, 5, 50},
                                                               {"5x5_100", cv::aruco::DICT_5X5_100, 5, 100},
                                                               {"5x5_250", cv::aruco::DICT_5X5_250, 5, 250},
                                                               {"5x5_1000", cv::aruco::DICT_5X5_1000, 5, 1000}}};

/// Null if no dictionary has that name.
inline const NamedDictionary* find_dictionary(const std::string& name) {
    for (const NamedDictionary& dictionary : kDictionaries) {
        if (name == dictionary.name) return &dictionary;
    }
    return nullptr;
}

}  // namespace rs::capture
