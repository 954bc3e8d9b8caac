#include "Result_files.h"

#include "../Files/Model.h"

#include <csignal>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <system_error>

namespace Tool {

namespace {

std::string pending(const std::string& file)
{
  return file + ".part";
}

class Without_interrupts
{
public:
  Without_interrupts() : m_before(std::signal(SIGINT, SIG_IGN)) {}
  ~Without_interrupts() { std::signal(SIGINT, m_before); }
  Without_interrupts(const Without_interrupts&) = delete;
  Without_interrupts& operator=(const Without_interrupts&) = delete;

private:
  void (*m_before)(int);
};

} // namespace

bool is_writable(const std::string& file)
{
  if(file == stream_name) return true;
  const Without_interrupts guard;
  std::error_code error;
  const bool is_open = !std::filesystem::is_directory(file, error) && std::ofstream(pending(file)).is_open();
  std::remove(pending(file).c_str());
  return is_open;
}

bool is_same_file(const std::string& file, const std::string& other)
{
  std::error_code error;
  return std::filesystem::equivalent(file, other, error);
}

std::ostream& report_stream(const std::string& result)
{
  return result == stream_name ? std::cerr : std::cout;
}

std::string write_files(const Contents& files)
{
  const Without_interrupts guard;
  std::string failed;
  for(const auto& [name, text] : files) {
    if(!text) continue;
    if(name == stream_name) {
      if(!std::cout.write(text->data(), std::streamsize(text->size())).flush()) failed = name;
      continue;
    }
    std::ofstream out(pending(name), std::ios::binary);
    out.write(text->data(), std::streamsize(text->size()));
    out.close();
    if(!out && failed.empty()) failed = name;
  }
  for(const auto& [name, text] : files) {
    if(name == stream_name) continue;
    if(failed.empty() && text && std::rename(pending(name).c_str(), name.c_str()) != 0) failed = name;
    std::remove(pending(name).c_str());
  }
  for(const auto& [name, text] : files)
    if(failed.empty() && !text) std::remove(name.c_str());
  return failed;
}

} // namespace Tool
