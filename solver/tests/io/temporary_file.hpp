// A file name in the system's temporary folder that nobody else uses; the file is removed with the object.
#pragma once

#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>
#include <string>
#include <string_view>

namespace comma::solver::tests {

class TemporaryFile {
 public:
  explicit TemporaryFile(const std::string& extension = ".med") {
    std::random_device random;
    path_ = (std::filesystem::temp_directory_path() /
             ("comma_test_" + std::to_string(random()) + std::to_string(random()) + extension))
                .string();
  }
  ~TemporaryFile() {
    std::error_code ignored;
    std::filesystem::remove(path_, ignored);
  }
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;

  const std::string& path() const { return path_; }
  std::string bytes() const {
    std::ifstream file(path_, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
  }
  void fill(std::string_view bytes) const {
    std::ofstream file(path_, std::ios::binary | std::ios::trunc);
    file.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  }

 private:
  std::string path_;
};

}  // namespace comma::solver::tests
