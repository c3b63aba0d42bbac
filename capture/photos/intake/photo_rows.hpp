#pragma once
/// \file
/// Rows of photos by their file names: a folder with several turns, one per height of the camera, whose names carry row
/// and column ("img_r02_c013.jpg", "2-13.jpg", "B07.jpg", "low_07.jpg", "obj_30_120.png" for elevation and azimuth).

#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace rs::capture {

/// Photos of one turn.
struct PhotoRow {
    std::string label;                ///< the row, with its keyword, in lower case: "r02", "2", "b", "low", "el-30"
    std::vector<std::size_t> photos;  ///< indices into the names, in order of the columns
};

/// Groups photos by row, and orders rows and columns by their values: numbers, signed and decimal ones too, letters
/// (A, B, C), and heights (bottom, low, middle, high, top). Names must agree in their parts except for numbers, case
/// and separators, and name each pair of row and column once.
///
/// Keywords before the numbers ("row", "r", "ring", "el"; "col", "c", "az", "view") tell row from column. Two numbers
/// without keywords are row and column if the rows have columns in common; the row is the first number, unless the
/// first number is clearly the column: it has at least twice as many values, or spans more than 180 and the second
/// number does not.
/// Dates and times, constant numbers, counters beside row and column, exposures ("_ev2"), stereo pairs and names of
/// several objects do not make rows.
/// \param names file names with their extensions
/// \return at least two rows, the lowest value first; empty if the photos are one row. Each photo is in one row.
std::vector<PhotoRow> rows_by_name(std::span<const std::string> names);

}  // namespace rs::capture
