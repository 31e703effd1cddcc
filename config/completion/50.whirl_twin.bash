# Completion of `twin` in bash: commands, their options, scenes and models, as `twin` itself tells them. The set-up file
# of a devel or install space reads it; where bash-completion is, an installed one is found without.

_twin_scenes() {
  twin scenes | sed -nE 's/^([^ ]+)$/\1/p'
}

_twin() {
  local word=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD - 1]} command=${COMP_WORDS[1]} words=
  if ((COMP_CWORD == 1)); then
    words=$(twin --help | sed -nE 's/^  ([a-z]+) .*/\1/p; s/.*(--[a-z]+).*/\1/p')
  elif [[ $word == -* ]]; then
    words=$(twin "$command" --help 2>/dev/null | sed -nE 's/^  (-[a-z],)?(--[a-z-]+).*/\2/p')
  else
    case "$command $before" in
      *' --show') words=$(_twin_scenes) ;;
      *' --results' | *' --'[ailmopstw]*) ;; # a value of its own, mostly a file
      'models '* | 'new '*) words=$(twin models | sed -nE 's/^([a-z0-9_]+): .*/\1/p') ;;
      'controllers '*) words=$(twin controllers | sed -nE 's/^([a-z0-9_]+): .*/\1/p') ;;
      'routh '* | 'log '* | 'record '* | 'play '* | 'spy '* | 'watch '* | 'export '* | 'import '* | 'fit '* | 'sweep '* | 'scenes '*) ;;
      *) words=$(_twin_scenes) ;;
    esac
  fi
  mapfile -t COMPREPLY < <(compgen -W "$words" -- "$word")
}
complete -o default -F _twin twin # files where nothing else fits
