// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/networks/onnx_outline.hpp"

#include "files/refusal.hpp"
#include "files/text.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <set>

namespace mapscore::eval {
namespace {

namespace fs = std::filesystem;

/// The wire types of protocol buffers.
enum class Wire { varint = 0, fixed64 = 1, bytes = 2, fixed32 = 5 };

struct ProtoField {
  std::uint64_t number = 0;
  Wire wire = Wire::varint;
  std::uint64_t value = 0;      ///< of a varint
  std::string_view bytes = {};  ///< of the others
};

/// Walks the fields of one message. Throws Error where the bytes end too early.
class ProtoFields {
 public:
  ProtoFields(std::string_view bytes, const fs::path& file) : rest_(bytes), file_(file) {}

  [[nodiscard]] bool next(ProtoField& field) {
    if (rest_.empty()) return false;
    const std::uint64_t tag = varint();
    field = {.number = tag >> 3, .wire = static_cast<Wire>(tag & 7)};
    if (field.number == 0) damaged();
    switch (field.wire) {
      case Wire::varint:
        field.value = varint();
        return true;
      case Wire::fixed64:
        field.bytes = take(8);
        return true;
      case Wire::fixed32:
        field.bytes = take(4);
        return true;
      case Wire::bytes:
        field.bytes = take(varint());
        return true;
    }
    damaged();
  }

  [[nodiscard]] bool at_end() const { return rest_.empty(); }

  std::uint64_t varint() {
    std::uint64_t value = 0;
    for (int shift = 0; shift < 64; shift += 7) {
      const auto byte = static_cast<unsigned char>(take(1).front());
      value |= static_cast<std::uint64_t>(byte & 0x7f) << shift;
      if (byte < 0x80) return value;
    }
    damaged();
  }

 private:
  [[noreturn]] void damaged() const {
    refuse(file_, "is no ONNX file, or is cut short; export the network again");
  }
  std::string_view take(std::uint64_t count) {
    if (count > rest_.size()) damaged();
    const std::string_view taken = rest_.substr(0, count);
    rest_.remove_prefix(count);
    return taken;
  }

  std::string_view rest_;
  const fs::path& file_;
};

void for_each_field(std::string_view bytes, const fs::path& file, const auto& act) {
  ProtoFields fields(bytes, file);
  for (ProtoField field; fields.next(field);) act(field);
}

/// The side of a shape; a name in place of a number leaves it open, as does one of 0 or below.
std::int64_t side_of(std::string_view dimension, const fs::path& file) {
  std::int64_t side = -1;
  for_each_field(dimension, file, [&](const ProtoField& field) {
    if (field.number == 1) side = static_cast<std::int64_t>(field.value);
  });
  return side > 0 ? side : -1;
}

/// ValueInfoProto: 1 name, 2 type; of the type 1 the tensor's, of it 2 the shape, of it 1 sides.
OnnxTensor tensor_of(std::string_view value, const fs::path& file) {
  OnnxTensor tensor;
  for_each_field(value, file, [&](const ProtoField& field) {
    if (field.number == 1) tensor.name = field.bytes;
    if (field.number != 2) return;
    for_each_field(field.bytes, file, [&](const ProtoField& type) {
      if (type.number != 1) return;
      for_each_field(type.bytes, file, [&](const ProtoField& of_tensor) {
        if (of_tensor.number != 2) return;
        for_each_field(of_tensor.bytes, file, [&](const ProtoField& side) {
          if (side.number == 1) tensor.shape.push_back(side_of(side.bytes, file));
        });
      });
    });
  });
  return tensor;
}

template <class Word>
bool all_words(std::string_view bytes, const auto& good) {
  for (std::size_t at = 0; at + sizeof(Word) <= bytes.size(); at += sizeof(Word)) {
    Word word;
    std::memcpy(&word, bytes.data() + at, sizeof(Word));
    if (!good(word)) return false;
  }
  return true;
}

/// TensorProto's types of numbers with a fraction.
constexpr std::uint64_t kFloat = 1, kHalf = 10, kDouble = 11;

/// Bytes of a number of a type in raw data; 0 of types that OpenCV reads no weights of.
std::size_t bytes_of(std::uint64_t type) {
  constexpr std::array<std::size_t, 14> kBytes{0, 4, 1, 1, 2, 2, 4, 8, 0, 1, 2, 8, 4, 8};
  return type < kBytes.size() ? kBytes[type] : 0;
}

bool all_finite(std::string_view raw, std::uint64_t type) {
  const auto finite = [](auto number) { return std::isfinite(number); };
  if (type == kFloat) return all_words<float>(raw, finite);
  if (type == kDouble) return all_words<double>(raw, finite);
  const auto has_small_exponent = [](std::uint16_t half) { return (half & 0x7c00) != 0x7c00; };
  return type != kHalf || all_words<std::uint16_t>(raw, has_small_exponent);
}

/// A repeated whole number: one varint a field, or several packed.
void add_varints(const ProtoField& field, const fs::path& file, std::vector<std::uint64_t>& list) {
  if (field.wire == Wire::varint) {
    list.push_back(field.value);
  } else {
    ProtoFields packed(field.bytes, file);
    while (!packed.at_end()) list.push_back(packed.varint());
  }
}

/// Fewer than any network has; also where sides make up more than memory could hold.
constexpr std::uint64_t kMostNumbers = std::uint64_t{1} << 32;

std::uint64_t product_of(const std::vector<std::uint64_t>& sides, const fs::path& file) {
  std::uint64_t product = 1;
  for (const std::uint64_t side : sides) {
    if (side > kMostNumbers || product * side > kMostNumbers)
      refuse(file, "has weights of more than {} numbers; export the network again", kMostNumbers);
    product *= side;
  }
  return product;
}

struct Weights {
  std::string name;
  bool finite = true;
};

/// TensorProto: 1 sides, 2 type, 4 floats, 5 and 7 whole numbers, 8 name, 9 raw bytes, 10 doubles,
/// 13 and 14 another file. Throws Error where it holds another count of numbers than its sides say,
/// beyond which OpenCV would read.
Weights weights_of(std::string_view tensor, const fs::path& file) {
  Weights weights;
  std::uint64_t type = 0, numbers = 0;
  std::vector<std::uint64_t> sides, whole;
  bool elsewhere = false;
  for_each_field(tensor, file, [&](const ProtoField& field) {
    if (field.number == 1) add_varints(field, file, sides);
    if (field.number == 2) type = field.value;
    if (field.number == 8) weights.name = field.bytes;
    if (field.number == 13 || (field.number == 14 && field.value != 0)) elsewhere = true;
  });
  if (elsewhere)
    refuse(file, "its weights '{}' lie in another file; export them into one", shown(weights.name));
  for_each_field(tensor, file, [&](const ProtoField& field) {
    if (field.number == 5 || field.number == 7) add_varints(field, file, whole);
    const std::uint64_t of_field = field.number == 4    ? kFloat
                                   : field.number == 10 ? kDouble
                                   : field.number == 9  ? type
                                                        : 0;
    if (bytes_of(of_field) == 0) return;
    numbers += field.bytes.size() / bytes_of(of_field);
    if (!all_finite(field.bytes, of_field)) weights.finite = false;
  });
  numbers += whole.size();
  if (const std::uint64_t said = product_of(sides, file); said != numbers)
    refuse(file,
           "its weights '{}' are {} numbers, and their sides say {}; export the network again",
           shown(weights.name), numbers, said);
  return weights;
}

/// NodeProto: 1 inputs, 2 outputs, 5 attributes; of these 5 a tensor, held to its sides as weights
/// are. Throws Error where an input is none of the tensors `given` before it, in whose place OpenCV
/// would read nothing; adds the outputs.
void check_node(std::string_view node, const fs::path& file, std::set<std::string>& given) {
  std::vector<std::string> outputs;
  for_each_field(node, file, [&](const ProtoField& field) {
    const std::string name(field.bytes);
    if (field.number == 1 && !name.empty() && !given.contains(name))
      refuse(file,
             "an operator reads '{}', which nothing before it gives; export the network again",
             shown(name));
    if (field.number == 2) outputs.push_back(name);
    if (field.number != 5) return;
    for_each_field(field.bytes, file, [&](const ProtoField& attribute) {
      if (attribute.number == 5) static_cast<void>(weights_of(attribute.bytes, file));
    });
  });
  given.insert(outputs.begin(), outputs.end());
}

/// GraphProto: 1 nodes, 5 weights, 11 inputs, 12 outputs.
void read_graph(std::string_view graph, const fs::path& file, OnnxOutline& outline) {
  std::set<std::string> given;
  for_each_field(graph, file, [&](const ProtoField& field) {
    if (field.number == 11) outline.inputs.push_back(tensor_of(field.bytes, file));
    if (field.number == 12) outline.outputs.push_back(tensor_of(field.bytes, file));
    if (field.number != 5) return;
    const Weights one = weights_of(field.bytes, file);
    if (!one.finite && outline.not_finite.empty()) outline.not_finite = one.name;
    given.insert(one.name);
  });
  std::erase_if(outline.inputs,
                [&](const OnnxTensor& input) { return given.contains(input.name); });
  for (const OnnxTensor& input : outline.inputs) given.insert(input.name);
  for_each_field(graph, file, [&](const ProtoField& field) {
    if (field.number == 1) check_node(field.bytes, file, given);
  });
}

/// OperatorSetIdProto: 1 domain, 2 version; the version of ONNX itself, else 0.
std::int64_t opset_of(std::string_view bytes, const fs::path& file) {
  std::int64_t version = 0;
  bool own = true;
  for_each_field(bytes, file, [&](const ProtoField& field) {
    if (field.number == 1) own = field.bytes.empty() || field.bytes == "ai.onnx";
    if (field.number == 2) version = static_cast<std::int64_t>(field.value);
  });
  return own ? version : 0;
}

}  // namespace

OnnxOutline read_onnx_outline(std::string_view bytes, const fs::path& file) {
  OnnxOutline outline;
  bool has_graph = false;
  for_each_field(bytes, file, [&](const ProtoField& field) {
    if (field.number == 8) outline.opset = std::max(outline.opset, opset_of(field.bytes, file));
    if (field.number != 7) return;
    has_graph = true;
    read_graph(field.bytes, file, outline);
  });
  if (!has_graph) refuse(file, "is no ONNX file, or is cut short; export the network again");
  return outline;
}

std::string shape_text(const std::vector<std::int64_t>& shape) {
  std::string text;
  for (const std::int64_t side : shape)
    text += (text.empty() ? "" : " x ") + (side < 0 ? "?" : std::to_string(side));
  return text.empty() ? "a number" : text;
}

}  // namespace mapscore::eval
