/// A file that a run can be continued from.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace cdfp {

/// Digests of what a state only fits to, by the name that a message gives it.
using Fingerprint = std::vector<std::pair<std::string, std::uint64_t>>;

/// The file takes its place when it is whole; until then an earlier one stands.
void write_restart(const std::filesystem::path& path, const Fingerprint& fingerprint,
                   const std::string& state);

/// The state. Throws `Error(io)` for a file that cannot be read and `Error(bad_input)` for one that is none,
/// is cut short, damaged, of another version or of another model.
std::string read_restart(const std::filesystem::path& path, const Fingerprint& fingerprint);

}  // namespace cdfp
