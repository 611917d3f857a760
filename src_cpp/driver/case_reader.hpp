/// Case files: TOML that names what `Model` holds. `examples/laminated_glass/case.toml` shows every section.
#pragma once

#include <string>
#include <string_view>

#include "cdfp/model.hpp"

namespace cdfp {

/// Throws `Error(io)` if the file cannot be read and `Error(bad_input)` with file, line and column for what
/// is wrong in it: syntax, unknown keys, types, ranges, names that do not exist.
Model read_case(const std::string& path);

/// The same from the text of a file; `file` names it in messages.
Model parse_case(std::string_view text, const std::string& file);

}  // namespace cdfp
