// Runs tests in a new folder, so that tests that write files with the same name may run at the same time.
#define CATCH_CONFIG_RUNNER
#include <catch2/catch.hpp>

#include <cstdlib>
#include <filesystem>
#include <iostream>
#include <string>

int main(int argc, char** argv)
{
  const std::filesystem::path before = std::filesystem::current_path();
  std::string folder = (std::filesystem::temp_directory_path() / "shell_tests_XXXXXX").string();
  if(mkdtemp(folder.data()) == nullptr) {
    std::cerr << "The folder " << folder << " cannot be created." << std::endl;
    return EXIT_FAILURE;
  }
  std::filesystem::current_path(folder);
  const int failed = Catch::Session().run(argc, argv);
  std::filesystem::current_path(before);
  std::filesystem::remove_all(folder);
  return failed;
}
