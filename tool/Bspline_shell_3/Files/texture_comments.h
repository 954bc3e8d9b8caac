// Comments that name the textures of a PLY file.
#ifndef TOOL_FILES_TEXTURE_COMMENTS_H
#define TOOL_FILES_TEXTURE_COMMENTS_H

#include "MTL.h"
#include "Model.h"

#include <algorithm>
#include <string>
#include <vector>

namespace Tool {

const std::string texture_comment = "comment TextureFile "; // precedes the name of a file
constexpr const char* texture_number_name = "texnumber";    // label of polygons: the number of their texture

inline bool is_texture_comment(const std::string& comment)
{
  return comment.compare(0, texture_comment.size(), texture_comment) == 0;
}

// Returns the names of the textures of a model, relative to a folder.
inline std::vector<std::string> textures_in_comments(const Model& model, const std::string& folder)
{
  std::vector<std::string> names;
  for(const std::string& comment : model.comments)
    if(is_texture_comment(comment))
      names.push_back(moved_name(comment.substr(texture_comment.size()), model.folder, folder));
  return names;
}

// Replaces the comments that name textures.
inline void set_textures_in_comments(Model& model, const std::vector<std::string>& names)
{
  auto& all = model.comments;
  all.erase(std::remove_if(all.begin(), all.end(), is_texture_comment), all.end());
  for(const std::string& name : names) all.push_back(texture_comment + name);
}

} // namespace Tool

#endif // TOOL_FILES_TEXTURE_COMMENTS_H
