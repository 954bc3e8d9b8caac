// Files that exist during a test.
#ifndef TEMPORARY_FILES_H
#define TEMPORARY_FILES_H

#include <cstdio>
#include <fstream>
#include <iterator>
#include <string>

// A file that is removed at the end of the test.
struct Temporary_file
{
  explicit Temporary_file(const std::string& name, const std::string& text = std::string()) : name(name)
  {
    if(!text.empty()) std::ofstream(name, std::ios::binary) << text;
  }
  ~Temporary_file() { std::remove(name.c_str()); }
  std::string name;
};

inline std::string contents(const std::string& name)
{
  std::ifstream in(name, std::ios::binary);
  return std::string(std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>());
}

#endif // TEMPORARY_FILES_H
