#include "write_model.h"
#include "materials_of.h"
#include "read_model.h"
#include "texture_comments.h"

namespace Tool {

namespace {

typedef void (*Writer)(const Model&, const std::string&, Written_files&);

Writer writer_of(const std::string& file)
{
  const std::string extension = extension_of(file);
  return extension == ".ply"                           ? write_PLY
         : extension == ".obj"                         ? write_OBJ
         : extension == ".off"                         ? write_OFF
         : extension == ".stl"                         ? write_STL
         : extension == ".gltf" || extension == ".glb" ? write_GLTF
                                                       : Writer();
}

} // namespace

bool is_supported(const std::string& file)
{
  return file == stream_name || writer_of(file) != nullptr;
}

bool has_single_precision(const std::string& file)
{
  return writer_of(file) == write_GLTF;
}

Written_files write_model(const Model& model, const std::string& file)
{
  Written_files written;
  if(file != stream_name) {
    writer_of(file)(model, file, written);
    return written;
  }
  const std::string name = stream_name + ("." + model.format);
  Model single = model;
  if(model.format == "obj" && !materials_of(model)->materials.empty()) {
    single.materials.clear();
    single.assets.reset();
    set_textures_in_comments(single, {});
    written.warnings.push_back("The material library is omitted: the standard output is a single file.");
  }
  writer_of(name)(single, name, written);
  written.files[0].first = stream_name;
  return written;
}

} // namespace Tool
