// Writes mesh files.
#ifndef TOOL_FILES_WRITE_MODEL_H
#define TOOL_FILES_WRITE_MODEL_H

#include "File_status.h"
#include "Model.h"
#include "materials_of.h"

#include <string>
#include <utility>
#include <vector>

namespace Tool {

// Files that belong together, such as an OBJ file and its material library: pairs of a name and the contents. The first
// file has the requested name.
struct Written_files
{
  std::vector<std::pair<std::string, std::string> > files;
  std::vector<std::string> attributes; // names of the attributes that the files hold
  std::vector<std::string> warnings;   // sentences about data that the format cannot hold

  void hold(const Attribute& a) { attributes.push_back(a.name); }
  // \param format with its article
  void leave_out(const Attribute& a, const std::string& format)
  {
    warnings.push_back("The attribute \"" + a.name + "\" is omitted: " + format + " cannot store it.");
  }
  void leave_out_materials(const Model& model, const std::string& format)
  {
    if(!materials_of(model)->materials.empty())
      warnings.push_back("Materials and textures are omitted: " + format + " cannot store them.");
  }
};

// Returns whether models can be written to files with this name, or to the standard output.
bool is_supported(const std::string& file);

// Returns whether all coordinates in a file with this name have single precision.
bool has_single_precision(const std::string& file);

// Returns the contents of a file, whose extension selects the format. The standard output has the format of the model.
// \pre `is_supported(file)`
Written_files write_model(const Model& model, const std::string& file);

// Each function returns the contents of a file of one format.
void write_PLY(const Model& model, const std::string& file, Written_files& written);
void write_OBJ(const Model& model, const std::string& file, Written_files& written);
void write_OFF(const Model& model, const std::string& file, Written_files& written);
void write_STL(const Model& model, const std::string& file, Written_files& written);
void write_GLTF(const Model& model, const std::string& file, Written_files& written); // GLB for the extension .glb

} // namespace Tool

#endif // TOOL_FILES_WRITE_MODEL_H
