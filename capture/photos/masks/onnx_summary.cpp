#include "capture/photos/masks/onnx_summary.hpp"

#include "rayspace/base/printable.hpp"

#include <algorithm>
#include <array>
#include <optional>
#include <set>
#include <string_view>

namespace rs::capture {
namespace {

using Bytes = std::span<const std::byte>;

struct MalformedOnnx {
    std::string what;
};

// One field of a protocol-buffer message.
struct WireField {
    std::uint64_t number = 0;
    int wire_type = 0;        // 0 varint, 1 eight bytes, 2 length-delimited, 5 four bytes
    std::uint64_t value = 0;  // of a varint
    Bytes content;            // of the other wire types
};

[[noreturn]] void fail_early_end() {
    throw MalformedOnnx{"it ends early"};
}

// Reads the fields of one message.
class WireReader {
public:
    explicit WireReader(Bytes bytes) : rest_(bytes) {}

    // The next field; nothing at the end of the message.
    std::optional<WireField> next() {
        if (rest_.empty()) return std::nullopt;
        const std::uint64_t key = take_varint();
        WireField field;
        field.number = key >> 3;
        field.wire_type = static_cast<int>(key & 7);
        switch (field.wire_type) {
            case 0:
                field.value = take_varint();
                break;
            case 1:
                field.content = take(8);
                break;
            case 2:
                field.content = take(take_varint());
                break;
            case 5:
                field.content = take(4);
                break;
            default:
                throw MalformedOnnx{"a field has an unknown wire type"};
        }
        if (field.number == 0) throw MalformedOnnx{"a field has the number 0"};
        return field;
    }
    [[nodiscard]] bool at_end() const { return rest_.empty(); }
    std::uint64_t take_varint() {
        std::uint64_t value = 0;
        for (unsigned shift = 0; shift < 64; shift += 7) {
            if (rest_.empty()) fail_early_end();
            const auto byte = std::to_integer<std::uint64_t>(rest_.front());
            rest_ = rest_.subspan(1);
            value |= (byte & 0x7F) << shift;
            if (byte < 0x80) return value;
        }
        throw MalformedOnnx{"a number has more than 64 bits"};
    }

private:
    Bytes take(std::uint64_t size) {
        if (size > rest_.size()) fail_early_end();
        const Bytes taken = rest_.first(static_cast<std::size_t>(size));
        rest_ = rest_.subspan(static_cast<std::size_t>(size));
        return taken;
    }
    Bytes rest_;
};

std::string_view text_of(const WireField& field) {
    return {reinterpret_cast<const char*>(field.content.data()), field.content.size()};
}

// A message's field as a submessage.
WireReader message_of(const WireField& field) {
    if (field.wire_type != 2) throw MalformedOnnx{"a field has the wrong wire type"};
    return WireReader(field.content);
}

// Elements of a repeated field that may be packed, of `element_bytes` each; 0: varints.
std::uint64_t element_count(const WireField& field, std::size_t element_bytes) {
    if (field.wire_type != 2) return 1;
    if (element_bytes > 0) return field.content.size() / element_bytes;
    std::uint64_t count = 0;
    for (WireReader packed(field.content); !packed.at_end(); ++count) (void)packed.take_varint();
    return count;
}

// Bytes of an element in raw_data, by onnx.TensorProto.DataType; 0: a type that has none.
std::size_t raw_element_bytes(std::int64_t type) {
    constexpr std::array<std::size_t, 17> kBytes = {0, 4, 1, 1, 2, 2, 4, 8, 0, 1, 2, 8, 4, 8, 8, 16, 2};
    return type > 0 && type < static_cast<std::int64_t>(kBytes.size()) ? kBytes[static_cast<std::size_t>(type)] : 0;
}

struct Tensor {
    std::string name;
    std::int64_t type = 0;
    bool is_external = false;
    std::uint64_t elements = 1;  // by its shape
};

void multiply_dimension(Tensor& tensor, std::uint64_t size) {
    constexpr std::uint64_t kMostElements = std::uint64_t{1} << 31;
    if (size > kMostElements || tensor.elements * size > kMostElements) {
        throw MalformedOnnx{"tensor " + tensor.name + " has an impossible shape"};
    }
    tensor.elements *= size;
}

// onnx.TensorProto: dims = 1, data_type = 2, float_data = 4, int32_data = 5, int64_data = 7, name = 8, raw_data = 9,
// double_data = 10, uint64_data = 11, data_location = 14.
Tensor read_tensor(WireReader message) {
    Tensor tensor;
    std::optional<std::uint64_t> raw_bytes;
    std::uint64_t typed_elements = 0;
    while (const auto field = message.next()) {
        switch (field->number) {
            case 1:
                if (field->wire_type == 2) {
                    for (WireReader dims(field->content); !dims.at_end();) {
                        multiply_dimension(tensor, dims.take_varint());
                    }
                } else {
                    multiply_dimension(tensor, field->value);
                }
                break;
            case 2:
                tensor.type = static_cast<std::int64_t>(field->value);
                break;
            case 4:
                typed_elements += element_count(*field, 4);
                break;
            case 5:
            case 7:
            case 11:
                typed_elements += element_count(*field, 0);
                break;
            case 8:
                tensor.name = text_of(*field);
                break;
            case 9:
                raw_bytes = field->content.size();
                break;
            case 10:
                typed_elements += element_count(*field, 8);
                break;
            case 14:
                tensor.is_external = field->value == 1;
                break;
            default:
                break;
        }
    }
    const std::size_t element_bytes = raw_element_bytes(tensor.type);
    if (tensor.is_external || element_bytes == 0) return tensor;
    if (raw_bytes ? *raw_bytes != tensor.elements * element_bytes : typed_elements != tensor.elements) {
        throw MalformedOnnx{"the data of tensor " + tensor.name + " does not have the length of its shape"};
    }
    return tensor;
}

// onnx.TensorShapeProto: dim = 1 {dim_value = 1, dim_param = 2}.
std::vector<std::int64_t> read_shape(WireReader message) {
    std::vector<std::int64_t> shape;
    while (const auto field = message.next()) {
        if (field->number != 1) continue;
        if (shape.size() == kMaxOnnxValues) throw MalformedOnnx{"a shape has too many dimensions"};
        shape.push_back(-1);
        WireReader dimension = message_of(*field);
        while (const auto part = dimension.next()) {
            if (part->number == 1 && part->value > 0 && part->value <= INT32_MAX) {
                shape.back() = static_cast<std::int64_t>(part->value);
            }
        }
    }
    return shape;
}

// onnx.ValueInfoProto: name = 1, type = 2 {tensor_type = 1 {elem_type = 1, shape = 2}}.
OnnxValue read_value(WireReader message) {
    OnnxValue value;
    while (const auto field = message.next()) {
        if (field->number == 1) value.name = text_of(*field);
        if (field->number != 2) continue;
        WireReader type = message_of(*field);
        while (const auto kind = type.next()) {
            if (kind->number != 1) continue;
            WireReader tensor = message_of(*kind);
            while (const auto part = tensor.next()) {
                if (part->number == 1) value.element_type = static_cast<std::int64_t>(part->value);
                if (part->number == 2) value.shape = read_shape(message_of(*part));
            }
        }
    }
    return value;
}

class GraphReader {
public:
    // onnx.GraphProto: node = 1, initializer = 5, input = 11, output = 12.
    void read(WireReader graph) {
        while (const auto field = graph.next()) {
            switch (field->number) {
                case 1:
                    read_node(message_of(*field));
                    break;
                case 5:
                    weights_.insert(note(read_tensor(message_of(*field))).name);
                    break;
                case 11:
                    add(summary_.inputs, read_value(message_of(*field)));
                    break;
                case 12:
                    add(summary_.outputs, read_value(message_of(*field)));
                    break;
                default:
                    break;
            }
        }
    }
    OnnxSummary finish() {
        std::erase_if(summary_.inputs, [&](const OnnxValue& input) { return weights_.contains(input.name); });
        if (summary_.inputs.size() > kMaxOnnxValues) throw MalformedOnnx{"it has too many inputs"};
        return std::move(summary_);
    }

private:
    // onnx.NodeProto: op_type = 4, attribute = 5 {t = 5}.
    void read_node(WireReader node) {
        while (const auto field = node.next()) {
            if (field->number == 4) note_operator(text_of(*field));
            if (field->number != 5) continue;
            WireReader attribute = message_of(*field);
            while (const auto part = attribute.next()) {
                if (part->number == 5) (void)note(read_tensor(message_of(*part)));
            }
        }
    }
    Tensor note(Tensor tensor) {
        summary_.has_half_weights |= tensor.type == kOnnxFloat16 || tensor.type == kOnnxBfloat16;
        summary_.has_external_data |= tensor.is_external;
        return tensor;
    }
    void note_operator(std::string_view type) {
        const bool is_quantized = type == "DynamicQuantizeLinear" || type == "QuantizeLinear" ||
                                  type == "DequantizeLinear" || type == "ConvInteger" || type == "MatMulInteger" ||
                                  type.starts_with("QLinear");
        if (is_quantized && summary_.quantized_operator.empty()) summary_.quantized_operator = type;
    }
    static void add(std::vector<OnnxValue>& values, OnnxValue value) {
        constexpr std::size_t kMostWithWeights = 65536;
        if (values.size() == kMostWithWeights) throw MalformedOnnx{"it has too many inputs or outputs"};
        values.push_back(std::move(value));
    }

    OnnxSummary summary_;
    std::set<std::string> weights_;
};

}  // namespace

Result<OnnxSummary> read_onnx_summary(std::span<const std::byte> bytes, const std::string& file) {
    const auto refused = [&](const std::string& why) {
        return Error{printable(file + ": is not a valid ONNX model (" + why + "); export or download it again")};
    };
    try {
        // onnx.ModelProto: ir_version = 1, graph = 7.
        bool has_version = false;
        bool has_graph = false;
        GraphReader graph;
        WireReader model(bytes);
        while (const auto field = model.next()) {
            has_version |= field->number == 1 && field->wire_type == 0;
            if (field->number != 7) continue;
            has_graph = true;
            graph.read(message_of(*field));
        }
        if (!has_version || !has_graph) return refused("it has no graph");
        OnnxSummary summary = graph.finish();
        if (summary.outputs.size() > kMaxOnnxValues) return refused("it has too many outputs");
        return summary;
    } catch (const MalformedOnnx& malformed) {
        return refused(malformed.what);
    }
}

}  // namespace rs::capture
