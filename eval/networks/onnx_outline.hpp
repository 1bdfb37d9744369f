// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace mapscore::eval {

/// An input or output of a network as its file declares it.
struct OnnxTensor {
  std::string name;
  std::vector<std::int64_t> shape;  ///< -1 where a side is left open
};

/// What an ONNX file says of its network that OpenCV does not tell: with it, a network that does
/// not fit is refused by shape and version, not by what happens inside.
struct OnnxOutline {
  std::int64_t opset = 0;  ///< of the operators of ONNX itself
  std::vector<OnnxTensor> inputs, outputs;
  std::string not_finite;  ///< name of the first weights with NaN or infinity; empty: none
};

/// Reads the fields of ModelProto (onnx.proto3) that the outline holds, and skips the others.
/// Inputs that are weights too are left out. `file` opens the message of the Error thrown where the
/// bytes are cut or are no such file, weights hold more or fewer numbers than their sides say, or
/// an operator reads what nothing gives.
[[nodiscard]] OnnxOutline read_onnx_outline(std::string_view bytes,
                                            const std::filesystem::path& file);

/// "1 x 3 x 240 x 320", `?` where a side is open.
[[nodiscard]] std::string shape_text(const std::vector<std::int64_t>& shape);

}  // namespace mapscore::eval
