# SPDX-License-Identifier: Apache-2.0
# Copyright Contributors to the Regain project

# cmake -DNM=nm -DOBJECTS=a.o;b.o -DOWN=pattern [-DEXPECT_SOME=ON] -P shared_code.cmake
#
# Fails where an object that is compiled for one instruction set holds code that the linker may take
# for that of the same name in another object, which another processor runs: weak functions whose
# names do not hold the vector's type. With EXPECT_SOME it fails where there are none.

set(shared "")
foreach(object IN LISTS OBJECTS)
  execute_process(COMMAND ${NM} ${object} OUTPUT_VARIABLE symbols RESULT_VARIABLE failed)
  if(failed)
    message(FATAL_ERROR "${NM} cannot read ${object}")
  endif()
  string(REGEX MATCHALL "[0-9a-f]+ W [^\n]+" weak "${symbols}")
  foreach(symbol IN LISTS weak)
    if(NOT symbol MATCHES "${OWN}")
      list(APPEND shared "${symbol}")
    endif()
  endforeach()
endforeach()
list(REMOVE_DUPLICATES shared)
if(EXPECT_SOME)
  if(NOT shared)
    message(FATAL_ERROR "no shared code was found where there has to be some")
  endif()
elseif(shared)
  list(JOIN shared "\n" shared)
  message(FATAL_ERROR "code that other processors may run:\n${shared}")
endif()
