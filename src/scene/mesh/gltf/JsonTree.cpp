// SPDX-License-Identifier: MIT
#include "mesh/gltf/JsonTree.h"

#include <string>
#include <utility>
#include <vector>

namespace allpairs::scene {
namespace {

using Json = nlohmann::json;

/// What the library's reader finds, put where it belongs. Names and parameters are the library's.
class TreeBuilder {
 public:
  TreeBuilder(Json& root, std::size_t mostDepth) : m_root(root), m_mostDepth(mostDepth) {}

  [[nodiscard]] const JsonProblem& problem() const { return m_problem; }

  bool null() { return add(nullptr) != nullptr; }
  bool boolean(bool value) { return add(value) != nullptr; }
  bool number_integer(Json::number_integer_t value) { return add(value) != nullptr; }    // NOLINT
  bool number_unsigned(Json::number_unsigned_t value) { return add(value) != nullptr; }  // NOLINT
  bool number_float(Json::number_float_t value, const std::string& /*text*/) {           // NOLINT
    return add(value) != nullptr;
  }
  bool string(std::string& value) { return add(std::move(value)) != nullptr; }
  bool binary(Json::binary_t& value) { return add(std::move(value)) != nullptr; }

  bool start_object(std::size_t /*size*/) { return open(Json::value_t::object); }  // NOLINT
  bool start_array(std::size_t /*size*/) { return open(Json::value_t::array); }    // NOLINT
  bool end_object() { return close(); }                                            // NOLINT
  bool end_array() { return close(); }                                             // NOLINT

  bool key(const std::string& name) {
    m_value = &(*m_open.back())[name];
    return true;
  }

  bool parse_error(std::size_t /*position*/, const std::string& /*token*/, const Json::exception& problem) {  // NOLINT
    const auto* at = dynamic_cast<const Json::parse_error*>(&problem);
    if (at != nullptr) m_problem.byte = at->byte;
    return false;
  }

 private:
  Json* add(Json value) {
    if (!m_open.empty() && m_open.back()->is_array()) return &m_open.back()->emplace_back(std::move(value));
    Json& place = m_open.empty() ? m_root : *m_value;
    place = std::move(value);
    return &place;
  }

  bool open(Json::value_t type) {
    m_problem.isTooDeep = m_open.size() > m_mostDepth;
    if (m_problem.isTooDeep) return false;
    m_open.push_back(add(type));
    return true;
  }

  bool close() {
    m_open.pop_back();
    return true;
  }

  Json& m_root;
  std::size_t m_mostDepth;
  std::vector<Json*> m_open;  ///< Lists and objects that are not complete, from the outermost in.
  Json* m_value = nullptr;    ///< That of the key which was read last.
  JsonProblem m_problem;
};

}  // namespace

std::optional<JsonProblem> JsonTree::parse(std::string_view text, std::size_t mostDepth) {
  clear(root);
  TreeBuilder builder(root, mostDepth);
  if (Json::sax_parse(text.begin(), text.end(), &builder)) return std::nullopt;
  return builder.problem();
}

/// From the leaves up: an empty list or object asks for nothing.
void JsonTree::clear(Json& json) noexcept {
  if (!json.is_structured()) return;
  for (Json& child : json) clear(child);
  json.clear();
}

}  // namespace allpairs::scene
