#pragma once

/// \file
/// The text of a file in OpenCV's FileStorage format, looked at by a parser that survives anything
/// before OpenCV's own sees it. That one trusts what it reads: version 4.6 runs for ever on some
/// broken YAML and follows null pointers in some broken XML (found by tests/fuzz).

#include <filesystem>
#include <string>

namespace ringhook {

enum class OpenCvSyntax { kYaml, kYamlOrXml };

/// Throws InputError naming the file unless it is well-formed YAML behind the line %YAML:1.0 with
/// keys at the top or, where permitted, well-formed XML with the root opencv_storage.
std::string readOpenCvText(const std::filesystem::path& path, OpenCvSyntax syntax);

}  // namespace ringhook
