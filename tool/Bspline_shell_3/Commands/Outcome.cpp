#include "Outcome.h"
#include "Json.h"

#include <algorithm>
#include <cctype>
#include <cstddef>
#include <iostream>
#include <map>
#include <vector>

namespace Tool {

namespace {

void list_places(const char* kind, const std::vector<std::size_t>& places)
{
  constexpr std::size_t most = 10;
  if(places.empty()) return;
  std::cerr << kind << ":";
  for(std::size_t i = 0; i < (std::min)(places.size(), most); ++i) std::cerr << " " << places[i];
  if(places.size() > most) std::cerr << " ... (" << places.size() << " in total)";
  std::cerr << "\n";
}

} // namespace

int report(const Outcome& outcome, bool writes_json)
{
  if(outcome.message.empty()) return outcome.code;
  if(writes_json) {
    Json json;
    json.add("error", outcome.message)
      .add("file", outcome.file)
      .add("exit_code", std::size_t(outcome.code))
      .add("facets", outcome.offenders.facets)
      .add("vertices", outcome.offenders.vertices);
    std::cout << json.text() << std::endl;
  } else {
    std::cerr << outcome.file << ": " << outcome.message << std::endl;
    list_places("facets, counted from 0", outcome.offenders.facets);
    list_places("vertices, counted from 0", outcome.offenders.vertices);
  }
  return outcome.code;
}

std::string with_options(std::string message)
{
  static const std::map<std::string, std::string> options = {
    { "time_limit", "--time-limit" }, { "memory_limit", "--memory-limit" },    { "weld_tolerance", "--weld" },
    { "thickness", "--thickness" },   { "relative_thickness", "--thickness" }, { "largest_excised_share", "--excise" }
  };
  const auto is_of_name = [](unsigned char c) { return std::isalnum(c) || c == '_' || c == ':'; };
  for(std::size_t open = message.find(" ("); open != std::string::npos; open = message.find(" (", open)) {
    const std::size_t close = message.find(')', open);
    if(close == std::string::npos) break;
    const std::string name = message.substr(open + 2, close - open - 2);
    const auto option = options.find(name);
    const bool is_name = std::all_of(name.begin(), name.end(), is_of_name) && name.find('_') != std::string::npos;
    if(option == options.end() && is_name) message.erase(open, close + 1 - open);
    else {
      if(option != options.end()) message.replace(open + 2, name.size(), option->second);
      open += 2;
    }
  }
  return message;
}

} // namespace Tool
