# Writes a source file with the text of the page: cmake -DFOLDER=... -DTHREE=... -DSCRIPTS=... -DOUTPUT=... -P join_page.cmake
# FOLDER is that of this file. THREE is the file of three.js, or empty: then the text is empty. SCRIPTS are names of
# JavaScript files, separated by commas.
cmake_minimum_required(VERSION 3.18)
set(page "")
if(THREE)
  file(READ "${FOLDER}/page.html" page)
  file(READ "${FOLDER}/page.css" style)
  file(READ "${FOLDER}/three_license.txt" license)
  file(READ "${THREE}" three)
  set(script "")
  string(REPLACE "," ";" names "${SCRIPTS}")
  foreach(name IN LISTS names)
    file(READ "${FOLDER}/${name}" text)
    string(APPEND script "${text}\n")
  endforeach()
  string(REPLACE "@STYLE@" "${style}" page "${page}")
  string(REPLACE "@SCRIPT@" "${script}" page "${page}")
  # three.js comes last, because a search for marks would be slow in it.
  string(REPLACE "@THREE@" "/*\n${license}*/\n${three}" page "${page}")
endif()
file(WRITE "${OUTPUT}" "#include \"View/page_template.h\"

std::string_view Tool::page_template()
{
  return R\"page(${page})page\";
}
")
