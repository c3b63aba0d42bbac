#pragma once
// Summary of an ONNX file: inputs, outputs, the types of its weights. Read before cv::dnn loads the file,
// for two reasons: errors can name the cause (half precision, quantization, several inputs), and OpenCV 4.6 does not
// check that the data of a tensor has the length that its shape requires.
//
// The file is a protocol buffer (onnx/onnx.proto, messages ModelProto, GraphProto, TensorProto). Only the fields that
// are used here are read; weights are not copied. Subgraphs (bodies of If and Loop) are not examined.

#include "rayspace/base/result.hpp"

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace rs::capture {

/// Element types of onnx.TensorProto.DataType that are named here.
inline constexpr std::int64_t kOnnxFloat = 1;
inline constexpr std::int64_t kOnnxFloat16 = 10;
inline constexpr std::int64_t kOnnxBfloat16 = 16;

/// An input or output of the graph.
struct OnnxValue {
    std::string name;
    std::int64_t element_type = 0;    ///< onnx.TensorProto.DataType; 0: not stated
    std::vector<std::int64_t> shape;  ///< -1: not fixed (a name such as "batch", or nothing)
};

struct OnnxSummary {
    std::vector<OnnxValue> inputs;   ///< without those that are weights
    std::vector<OnnxValue> outputs;  ///< in the order of the file
    bool has_half_weights = false;   ///< float16 or bfloat16, in initializers or constants
    bool has_external_data = false;  ///< weights are in another file
    std::string quantized_operator;  ///< the first operator of integer arithmetic, such as "ConvInteger"; empty: none
};

/// Largest number of inputs, of outputs, and of dimensions of a shape that are accepted.
inline constexpr std::size_t kMaxOnnxValues = 64;

/// \param bytes the whole file.
/// \param file  its name, for errors.
/// \return an error if `bytes` is not an ONNX model, ends early, or holds a tensor whose data has another length than
///         its shape requires. Memory beyond the result: the names of the weights. Pure; thread-safe.
Result<OnnxSummary> read_onnx_summary(std::span<const std::byte> bytes, const std::string& file);

}  // namespace rs::capture
