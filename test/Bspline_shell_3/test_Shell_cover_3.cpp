// Shell_cover_3.h
