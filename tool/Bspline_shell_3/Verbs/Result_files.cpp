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
  for(const auto& file : files) {
    if(file.first == stream_name) {
      if(!std::cout.write(file.second.data(), std::streamsize(file.second.size())).flush()) failed = file.first;
      continue;
    }
    std::ofstream out(pending(file.first), std::ios::binary);
    out.write(file.second.data(), std::streamsize(file.second.size()));
    out.close();
    if(!out && failed.empty()) failed = file.first;
  }
  for(const auto& file : files) {
    if(file.first == stream_name) continue;
    if(failed.empty() && std::rename(pending(file.first).c_str(), file.first.c_str()) != 0) failed = file.first;
    std::remove(pending(file.first).c_str());
  }
  return failed;
}

} // namespace Tool
