#include "vtu_reader.hpp"

#include <zlib.h>

#include <cstdint>
#include <fstream>
#include <sstream>

namespace cdfp::sample {
namespace {

void demand(bool holds, const std::string& what) {
  if (!holds) throw std::runtime_error(what);
}

struct Tag {
  std::string name;
  std::map<std::string, std::string> attributes;
  bool closing = false, empty = false;
  std::size_t end = 0;  ///< first character behind the tag
};

Tag next_tag(const std::string& text, std::size_t from) {
  const std::size_t begin = text.find('<', from), end = text.find('>', begin);
  demand(begin != std::string::npos && end != std::string::npos, "a tag is missing");
  Tag tag;
  tag.end = end + 1;
  std::string inside = text.substr(begin + 1, end - begin - 1);
  if (inside.front() == '/') tag.closing = true, inside.erase(0, 1);
  if (inside.back() == '/' || inside.back() == '?') tag.empty = true, inside.pop_back();
  std::size_t at = inside.find(' ');
  tag.name = inside.substr(0, at);
  while (at != std::string::npos) {
    at = inside.find_first_not_of(' ', at);
    if (at == std::string::npos) break;
    const std::size_t equals = inside.find("=\"", at), close = inside.find('"', equals + 2);
    demand(equals != std::string::npos && close != std::string::npos, "attribute of " + tag.name);
    demand(
        tag.attributes.emplace(inside.substr(at, equals - at), inside.substr(equals + 2, close - equals - 2))
            .second,
        "attribute twice in " + tag.name);
    at = close + 1 < inside.size() ? close + 1 : std::string::npos;
  }
  return tag;
}

std::size_t bytes_of(const std::string& type) {
  if (type == "Float64" || type == "Int64") return 8;
  if (type == "Int32") return 4;
  demand(type == "UInt8", "unknown type " + type);
  return 1;
}

/// Takes one array off the appended data at `at`, which moves behind it.
std::string decode(const std::string& data, std::size_t& at) {
  const auto number = [&] {
    std::uint64_t value = 0;
    demand(at + 8 <= data.size(), "appended data end in a header");
    std::memcpy(&value, &data[at], 8);
    at += 8;
    return value;
  };
  const std::uint64_t blocks = number(), size = number(), last = number();
  demand(last < size, "last block longer than a block");
  std::vector<std::uint64_t> packed(blocks);
  for (std::uint64_t& bytes : packed) bytes = number();
  std::string out;
  for (std::uint64_t b = 0; b < blocks; ++b) {
    const std::uint64_t wanted = b + 1 == blocks && last ? last : size;
    demand(at + packed[b] <= data.size(), "appended data end in a block");
    std::string block(wanted, '\0');
    uLongf length = wanted;
    demand(uncompress(reinterpret_cast<Bytef*>(block.data()), &length,
                      reinterpret_cast<const Bytef*>(&data[at]), packed[b]) == Z_OK,
           "zlib refuses a block");
    demand(length == wanted, "a block has another length than its header says");
    at += packed[b];
    out += block;
  }
  return out;
}

}  // namespace

std::string read_text(const std::filesystem::path& path) {
  std::ifstream stream(path, std::ios::binary);
  demand(stream.good(), "no file " + path.string());
  std::ostringstream text;
  text << stream.rdbuf();
  return text.str();
}

Vtu read_vtu(const std::filesystem::path& path) {
  const std::string text = read_text(path);
  const std::string opening = "<AppendedData encoding=\"raw\">\n_",
                    ending = "\n  </AppendedData>\n</VTKFile>\n";
  const std::size_t split = text.find(opening);
  demand(split != std::string::npos, "no appended data");
  demand(text.size() > ending.size() && text.substr(text.size() - ending.size()) == ending,
         "the end is missing");
  const std::size_t begin = split + opening.size();
  const std::string data = text.substr(begin, text.size() - ending.size() - begin);

  Vtu vtu;
  std::vector<std::string> open;
  std::size_t taken = 0;
  for (std::size_t at = 0; open.size() != 1 || open[0] != "VTKFile" || taken == 0;) {
    const Tag tag = next_tag(text, at);
    if (tag.closing) {
      demand(!open.empty() && open.back() == tag.name, "tags are not nested at " + tag.name);
      open.pop_back();
    } else if (!tag.empty) {
      open.push_back(tag.name);
    }
    if (tag.name == "VTKFile" && !tag.closing) {
      demand(tag.attributes.at("type") == "UnstructuredGrid", "type");
      demand(tag.attributes.at("byte_order") == "LittleEndian", "byte order");
      demand(tag.attributes.at("header_type") == "UInt64", "header type");
      demand(tag.attributes.at("compressor") == "vtkZLibDataCompressor", "compressor");
    }
    if (tag.name == "Piece" && !tag.closing) {
      vtu.points = std::stoul(tag.attributes.at("NumberOfPoints"));
      vtu.cells = std::stoul(tag.attributes.at("NumberOfCells"));
    }
    if (tag.name == "DataArray" && !tag.closing && tag.attributes.at("format") == "ascii") {
      demand(tag.attributes.at("Name") == "TimeValue", "the only readable array is the time");
      vtu.time = std::stod(text.substr(tag.end));
    }
    if (tag.name == "DataArray" && tag.empty) {
      VtuArray array;
      array.type = tag.attributes.at("type");
      array.components = std::stoi(tag.attributes.at("NumberOfComponents"));
      std::size_t offset = std::stoul(tag.attributes.at("offset"));
      array.bytes = decode(data, offset);
      taken = std::max(taken, offset);
      demand(array.bytes.size() % (bytes_of(array.type) * static_cast<std::size_t>(array.components)) == 0,
             "size of " + tag.attributes.at("Name"));
      demand(vtu.sections[open.back()].emplace(tag.attributes.at("Name"), array).second, "name twice");
    }
    at = tag.end;
    if (at >= split) break;
  }
  demand(taken == data.size(), "appended data that no array names");
  return vtu;
}

std::vector<PvdEntry> read_pvd(const std::filesystem::path& path) {
  const std::string text = read_text(path);
  const std::string ending = "  </Collection>\n</VTKFile>\n";
  demand(text.size() > ending.size() && text.substr(text.size() - ending.size()) == ending,
         "the end is missing");
  std::vector<PvdEntry> entries;
  for (std::size_t at = 0; at + 1 < text.size();) {
    const Tag tag = next_tag(text, at);
    if (tag.name == "DataSet")
      entries.push_back({std::stod(tag.attributes.at("timestep")), tag.attributes.at("file")});
    at = tag.end;
  }
  return entries;
}

}  // namespace cdfp::sample
